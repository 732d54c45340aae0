#include "hooke/io/text.h"

#include "hooke/core/parallel.h"

namespace hooke {

void append_all(std::string& text, const std::vector<std::string>& pieces) {
  size_t size = text.size();
  for (const std::string& piece : pieces) size += piece.size();
  text.reserve(size);
  for (const std::string& piece : pieces) text += piece;
}

namespace {

/// Calls append(text, i) for i in [0, count), in parallel on separate pieces that are then concatenated.
template <typename Append>
void append_rows(std::string& text, size_t count, const Append& append) {
  constexpr size_t block = 4096;
  std::vector<std::string> pieces(count / block + 1);
  parallel_for(pieces.size(), 1, [&](size_t begin, size_t end) {
    for (size_t p = begin; p < end; ++p)
      for (size_t i = p * block; i < std::min(count, (p + 1) * block); ++i) append(pieces[p], i);
  });
  append_all(text, pieces);
}

void append_value(std::string& row, NumberType type, double value) {
  if (is_integer(type))
    append_number(row, static_cast<long long>(value));
  else if (type == NumberType::float32)
    append_number(row, static_cast<float>(value));
  else
    append_number(row, value);
}

void append_values(std::string& row, const ChannelList& channels, size_t vertex) {
  for (const VertexChannel* channel : channels) {
    row += ' ';
    append_value(row, channel->type, channel->values[vertex]);
  }
}

}  // namespace

void append_vertex_rows(std::string& text, const Eigen::Ref<const Mat3X>& points, const char* prefix,
                        const ChannelList& channels) {
  append_rows(text, points.cols(), [&](std::string& row, size_t v) {
    row += prefix;
    append_three(row, points.col(static_cast<Eigen::Index>(v)));
    append_values(row, channels, v);
    row += '\n';
  });
}

void append_value_rows(std::string& text, const char* prefix, const ChannelList& channels) {
  if (channels.empty()) return;
  append_rows(text, channels.front()->values.size(), [&](std::string& row, size_t v) {
    row += prefix;
    append_values(row, channels, v);
    row += '\n';
  });
}

void append_face_rows(std::string& text, const std::vector<Triangle>& faces, const char* prefix, int first_id,
                      const std::vector<const char*>& repeats, const ChannelList& channels) {
  append_rows(text, faces.size(), [&](std::string& row, size_t f) {
    row += prefix;
    for (const int vertex : faces[f]) {
      row += ' ';
      append_number(row, vertex + first_id);
      for (const char* separator : repeats) {
        row += separator;
        append_number(row, vertex + first_id);
      }
    }
    append_values(row, channels, f);
    row += '\n';
  });
}

namespace {

constexpr size_t piece_size = size_t{1} << 17;  // bytes

/// The offset after the first line end at or after `from` that is not continued by a '\\'.
size_t cut_after(std::string_view text, size_t from) {
  for (size_t end = text.find('\n', from); end != text.npos; end = text.find('\n', end + 1)) {
    const size_t last = end > 0 && text[end - 1] == '\r' ? end - 1 : end;
    if (last == 0 || text[last - 1] != '\\') return end + 1;
  }
  return text.size();
}

/// Counts the rows of the piece. Returns the number of its lines.
int count_rows(TextPiece& piece, std::span<const std::string_view> keywords) {
  piece.rows_of.assign(keywords.size(), 0);
  Scanner counter = piece.scanner;
  while (counter.next_line()) {
    ++piece.rows;
    if (keywords.empty()) continue;
    const std::string_view first = counter.token();
    for (size_t k = 0; k < keywords.size(); ++k) piece.rows_of[k] += first == keywords[k];
  }
  return counter.line();
}

}  // namespace

std::vector<TextPiece> remaining_pieces(Scanner scanner, std::span<const std::string_view> keywords) {
  scanner.finish_line();
  const std::string_view text = scanner.rest();
  std::vector<TextPiece> pieces;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = cut_after(text, std::min(text.size(), begin + piece_size));
    pieces.push_back({scanner.on(text.substr(begin, end - begin), 0)});
    begin = end;
  }
  std::vector<int> lines(pieces.size());
  parallel_for(pieces.size(), 1, [&](size_t begin, size_t end) {
    for (size_t p = begin; p < end; ++p) lines[p] = count_rows(pieces[p], keywords);
  });
  int line = scanner.line();
  long long row = 0;
  for (size_t p = 0; p < pieces.size(); ++p) {
    pieces[p].scanner = scanner.on(pieces[p].scanner.rest(), line);
    pieces[p].first_row = row;
    line += lines[p];
    row += pieces[p].rows;
  }
  return pieces;
}

}  // namespace hooke
