#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>

#include "hooke/io/ply.h"
#include "hooke/io/text_rows.h"

namespace hooke {
namespace {

const char* name_of(PlyEncoding encoding) {
  switch (encoding) {
    case PlyEncoding::ascii:
      return "ascii";
    case PlyEncoding::binary_little_endian:
      return "binary_little_endian";
    case PlyEncoding::binary_big_endian:
      return "binary_big_endian";
  }
  return "";
}

std::string header_text(Eigen::Index vertices, size_t faces, PlyEncoding encoding) {
  return fmt::format(
      "ply\nformat {} 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      name_of(encoding), vertices, faces);
}

/// The value's bytes at `at`, which moves on.
template <typename T>
void put(char*& at, T value, bool swap) {
  auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (swap) std::reverse(raw.begin(), raw.end());
  at = std::copy(raw.begin(), raw.end(), at);
}

void append_binary(std::string& bytes, Eigen::Ref<const Mat3X> points, const std::vector<Triangle>& triangles,
                   bool swap) {
  constexpr size_t vertex_size = 3 * sizeof(double), face_size = 1 + 3 * sizeof(int);
  const size_t header = bytes.size();
  bytes.resize(header + static_cast<size_t>(points.cols()) * vertex_size + triangles.size() * face_size);
  char* at = bytes.data() + header;
  for (Eigen::Index v = 0; v < points.cols(); ++v)
    for (int k = 0; k < 3; ++k) put(at, points(k, v), swap);
  for (const Triangle& triangle : triangles) {
    *at++ = 3;
    for (const int id : triangle) put(at, id, swap);
  }
}

}  // namespace

std::string write_ply(Eigen::Ref<const Mat3X> points, const std::vector<Triangle>& triangles,
                      PlyEncoding encoding) {
  const bool ascii = encoding == PlyEncoding::ascii;
  std::string bytes = header_text(points.cols(), triangles.size(), encoding);
  if (ascii) {
    append_vertex_rows(bytes, points, "");
    append_face_rows(bytes, triangles, "3 ", 0);
  } else {
    const bool little = encoding == PlyEncoding::binary_little_endian;
    append_binary(bytes, points, triangles, little != (std::endian::native == std::endian::little));
  }
  return bytes;
}

}  // namespace hooke
