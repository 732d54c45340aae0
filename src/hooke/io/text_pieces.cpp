#include "hooke/io/text_pieces.h"

namespace hooke {
namespace {

constexpr size_t piece_size = size_t{1} << 17;  // bytes

/// The place after the first line end from `from` on at which the text can be cut.
size_t cut_after(std::string_view text, size_t from) {
  for (size_t end = text.find('\n', from); end != text.npos; end = text.find('\n', end + 1)) {
    const size_t last = end > 0 && text[end - 1] == '\r' ? end - 1 : end;
    if (last == 0 || text[last - 1] != '\\') return end + 1;
  }
  return text.size();
}

/// Sets the counts of rows in the piece. Returns the number of its lines.
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
