#include "hooke/io/rewrite_formats.h"

#include <cmath>
#include <optional>
#include <vector>

#include "hooke/io/binary_numbers.h"
#include "hooke/io/binary_off.h"
#include "hooke/io/edited_copy.h"
#include "hooke/io/off.h"
#include "hooke/io/off_format.h"
#include "hooke/io/renewed_normals.h"
#include "hooke/io/text.h"

namespace hooke {
namespace {

// The normals of a file whose keyword announces them, unless its vertices have too few or too many numbers.
std::optional<RenewedNormals> renew_off_normals(std::string_view bytes, const std::string& name,
                                                const OffHeader& header, const Mat3X& points) {
  if (!header.normals) return std::nullopt;
  const MeshFile file = read_off(bytes, name);
  if (!has_normals(file.vertex_data)) return std::nullopt;
  return renew_vertex_normals({file.polygons, file.points, points});
}

std::string rewrite_off_text(std::string_view text, const std::string& name, const Mat3X& points) {
  Scanner start(text, name, off_syntax);
  const OffHeader header = read_off_header(start);
  const std::optional<RenewedNormals> normals = renew_off_normals(text, name, header, points);
  return edited_text(text, remaining_pieces(start), [&](const TextPiece& piece, size_t, EditedCopy& copy) {
    Scanner in = piece.scanner;
    for (long long row = piece.first_row; row < header.vertices && in.next_line(); ++row) {
      for (Eigen::Index k = 0; k < 3; ++k) copy.set_number(in.token(), points(k, row));
      if (!normals || !normals->renewed[row]) continue;
      for (Eigen::Index k = 0; k < 3; ++k) copy.set_normal(in.token(), normals->values(k, row));
    }
  });
}

// Rewrites the vertices of a binary file, whose numbers are floats.
class BinaryOffWriter {
 public:
  BinaryOffWriter(std::string_view bytes, RewrittenMesh& result) : result_(result) { result_.bytes = bytes; }

  // Writes the value, if another one is there. Returns it as it then stands there.
  double set(size_t offset, double value) {
    const std::string_view there = std::string_view(result_.bytes).substr(offset);
    const double rounded = static_cast<float>(value);
    if (binary_number(there, NumberType::float32, swap_) == rounded) return rounded;
    if (!std::isfinite(rounded)) result_.obstacle = out_of_range;
    char* at = result_.bytes.data() + offset;
    put_binary(at, NumberType::float32, rounded, swap_);
    return rounded;
  }

 private:
  RewrittenMesh& result_;
  bool swap_ = swaps_bytes(std::endian::big);
};

RewrittenMesh rewrite_binary_off(std::string_view bytes, const std::string& name, const Mat3X& points) {
  const BinaryOffLayout layout = binary_off_layout(bytes, name);
  const std::optional<RenewedNormals> normals = renew_off_normals(bytes, name, layout.header, points);
  constexpr size_t number = 4;  // bytes
  RewrittenMesh result;
  result.rounded.resize(3, points.cols());
  BinaryOffWriter rewriter(bytes, result);
  for (int v = 0; v < layout.header.vertices; ++v) {
    const size_t vertex = layout.vertices + v * layout.vertex_size;
    for (int k = 0; k < 3; ++k) result.rounded(k, v) = rewriter.set(vertex + k * number, points(k, v));
    if (!normals || !normals->renewed[v]) continue;
    for (int k = 0; k < 3; ++k) rewriter.set(vertex + (3 + k) * number, normals->values(k, v) + 0.);
  }
  return result;
}

}  // namespace

RewrittenMesh rewrite_off(std::string_view bytes, const std::string& name, const Mat3X& points) {
  Scanner in(bytes, name, off_syntax);
  if (read_off_header(in).binary) return rewrite_binary_off(bytes, name, points);
  RewrittenMesh result;
  result.bytes = rewrite_off_text(bytes, name, points);
  return result;
}

}  // namespace hooke
