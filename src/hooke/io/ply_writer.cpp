#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "hooke/io/ply.h"
#include "hooke/io/ply_header.h"
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

const char* name_of(PlyType type) {
  static constexpr const char* names[] = {"char", "uchar", "short", "ushort",
                                          "int",  "uint",  "float", "double"};
  return names[static_cast<size_t>(type)];
}

std::string header_text(Eigen::Index vertices, size_t faces, PlyEncoding encoding, const VertexData& data) {
  std::string channels;
  for (const VertexChannel& channel : data)
    channels += fmt::format("property {} {}\n", name_of(channel.type), channel.name);
  return fmt::format(
      "ply\nformat {} 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n{}"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      name_of(encoding), vertices, channels, faces);
}

/// The value's bytes at `at`, which moves on.
template <typename T>
void put(char*& at, T value, bool swap) {
  auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (swap) std::reverse(raw.begin(), raw.end());
  at = std::copy(raw.begin(), raw.end(), at);
}

void put(char*& at, PlyType type, double value, bool swap) {
  switch (type) {
    case PlyType::int8:
      return put(at, static_cast<std::int8_t>(value), swap);
    case PlyType::uint8:
      return put(at, static_cast<std::uint8_t>(value), swap);
    case PlyType::int16:
      return put(at, static_cast<std::int16_t>(value), swap);
    case PlyType::uint16:
      return put(at, static_cast<std::uint16_t>(value), swap);
    case PlyType::int32:
      return put(at, static_cast<std::int32_t>(value), swap);
    case PlyType::uint32:
      return put(at, static_cast<std::uint32_t>(value), swap);
    case PlyType::float32:
      return put(at, static_cast<float>(value), swap);
    case PlyType::float64:
      return put(at, value, swap);
  }
}

void append_binary(std::string& bytes, Eigen::Ref<const Mat3X> points, const std::vector<Triangle>& triangles,
                   const VertexData& data, bool swap) {
  constexpr size_t face_size = 1 + 3 * sizeof(int);
  size_t vertex_size = 3 * sizeof(double);
  for (const VertexChannel& channel : data) vertex_size += size_of(channel.type);
  const size_t header = bytes.size();
  bytes.resize(header + static_cast<size_t>(points.cols()) * vertex_size + triangles.size() * face_size);
  char* at = bytes.data() + header;
  for (Eigen::Index v = 0; v < points.cols(); ++v) {
    for (int k = 0; k < 3; ++k) put(at, points(k, v), swap);
    for (const VertexChannel& channel : data)
      put(at, channel.type, channel.values[static_cast<size_t>(v)], swap);
  }
  for (const Triangle& triangle : triangles) {
    *at++ = 3;
    for (const int id : triangle) put(at, id, swap);
  }
}

}  // namespace

std::string write_ply(Eigen::Ref<const Mat3X> points, const std::vector<Triangle>& triangles,
                      PlyEncoding encoding, const VertexData& data) {
  const bool ascii = encoding == PlyEncoding::ascii;
  std::string bytes = header_text(points.cols(), triangles.size(), encoding, data);
  if (ascii) {
    ChannelList channels;
    for (const VertexChannel& channel : data) channels.push_back(&channel);
    append_vertex_rows(bytes, points, "", channels);
    append_face_rows(bytes, triangles, "3", 0);
  } else {
    const bool little = encoding == PlyEncoding::binary_little_endian;
    append_binary(bytes, points, triangles, data, little != (std::endian::native == std::endian::little));
  }
  return bytes;
}

}  // namespace hooke
