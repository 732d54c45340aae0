#include "hooke/io/text_rows.h"

#include "hooke/io/append_number.h"
#include "hooke/parallel.h"

namespace hooke {
namespace {

/// Appends what append(text, i) appends for i in [0, count), made in parallel piece by piece.
template <typename Append>
void append_rows(std::string& text, size_t count, const Append& append) {
  constexpr size_t block = 16384;
  std::vector<std::string> pieces(count / block + 1);
  parallel_for(pieces.size(), 1, [&](size_t begin, size_t end) {
    for (size_t p = begin; p < end; ++p)
      for (size_t i = p * block; i < std::min(count, (p + 1) * block); ++i) append(pieces[p], i);
  });
  size_t size = text.size();
  for (const std::string& piece : pieces) size += piece.size();
  text.reserve(size);
  for (const std::string& piece : pieces) text += piece;
}

void append_value(std::string& row, NumberType type, double value) {
  if (is_integer(type))
    append_number(row, static_cast<long long>(value));
  else if (type == NumberType::float32)
    append_number(row, static_cast<float>(value));
  else
    append_number(row, value);
}

}  // namespace

void append_vertex_rows(std::string& text, Eigen::Ref<const Mat3X> points, const char* prefix,
                        const VertexData& data) {
  append_rows(text, static_cast<size_t>(points.cols()), [&](std::string& row, size_t v) {
    row += prefix;
    append_three(row, points.col(static_cast<Eigen::Index>(v)));
    for (const VertexChannel& channel : data) {
      row += ' ';
      append_value(row, channel.type, channel.values[v]);
    }
    row += '\n';
  });
}

void append_face_rows(std::string& text, const std::vector<Triangle>& faces, const char* prefix,
                      int first_id) {
  append_rows(text, faces.size(), [&](std::string& row, size_t f) {
    const auto& [a, b, c] = faces[f];
    row += prefix;
    append_three(row, Triangle{a + first_id, b + first_id, c + first_id});
    row += '\n';
  });
}

}  // namespace hooke
