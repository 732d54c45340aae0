#include "hooke/io/ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include "hooke/error.h"
#include "hooke/io/append_number.h"
#include "hooke/io/ply_body.h"
#include "hooke/io/ply_header.h"
#include "hooke/io/printable.h"

namespace hooke {
namespace {

bool is_index_list(const PlyProperty& property) {
  return property.name == "vertex_indices" || property.name == "vertex_index";
}

// Which coordinate a vertex property is; -1 for none.
int coordinate_of(const PlyProperty& property) {
  return property.name == "x" ? 0 : property.name == "y" ? 1 : property.name == "z" ? 2 : -1;
}

void check_vertex_element(const PlyElement& vertex, const std::string& name) {
  for (const char* coordinate : {"x", "y", "z"})
    if (std::none_of(vertex.properties.begin(), vertex.properties.end(), [&](const PlyProperty& property) {
          return property.name == coordinate && !property.count_type;
        }))
      throw InputError(fmt::format("{}: vertices have no scalar property '{}'; expected x, y and z; add it",
                                   name, coordinate));
  if (vertex.count > std::numeric_limits<int>::max())
    throw InputError(fmt::format(
        "{}: {} vertices in the header; expected at most 2147483647; correct the count", name, vertex.count));
}

void check_face_element(const PlyElement& face, const std::string& name) {
  const auto lists = std::count_if(face.properties.begin(), face.properties.end(), is_index_list);
  const auto usable =
      std::count_if(face.properties.begin(), face.properties.end(), [](const PlyProperty& property) {
        return is_index_list(property) && property.count_type && is_integer(property.type);
      });
  if (lists != 1 || usable != 1)
    throw InputError(fmt::format(
        "{}: faces without one integer list 'vertex_indices'; expected it once; correct the header", name));
}

template <typename Body>
void read_vertices(Body& body, const PlyElement& vertex, Mat3X& points) {
  static constexpr const char* names[] = {"x", "y", "z"};
  points.resize(3, vertex.count);
  for (long long row = 0; row < vertex.count; ++row) {
    body.begin_row(vertex, row);
    for (const PlyProperty& property : vertex.properties) {
      const int k = coordinate_of(property);
      if (k >= 0)
        points(k, row) = body.number(property.type, names[k]);
      else
        skip_property(body, property);
    }
    body.end_row();
  }
}

template <typename Body>
void read_corners(Body& body, const PlyProperty& list, long long vertex_count, MeshFile& file) {
  const long long corners = body.integer(*list.count_type, "face size");
  if (corners < 3)
    body.fail(fmt::format("face with {} corners; expected 3 or more; correct or remove it", corners));
  for (long long k = 0; k < corners; ++k) {
    const long long id = body.integer(list.type, "face corner");
    if (id < 0 || id >= vertex_count)
      body.fail(fmt::format("vertex index {}; expected 0 to {}; correct the index", id, vertex_count - 1));
    file.polygons.items.push_back(static_cast<int>(id));
  }
}

template <typename Body>
void read_faces(Body& body, const PlyElement& face, long long vertex_count, MeshFile& file) {
  for (long long row = 0; row < face.count; ++row) {
    body.begin_row(face, row);
    if (body.line() > 0) file.lines.push_back(body.line());
    for (const PlyProperty& property : face.properties) {
      if (is_index_list(property))
        read_corners(body, property, vertex_count, file);
      else
        skip_property(body, property);
    }
    body.end_row();
    end_polygon(file);
  }
}

template <typename Body>
void read_body(Body body, const PlyHeader& header, const PlyElement& vertex, const PlyElement& face,
               MeshFile& file) {
  for (const PlyElement& element : header.elements) {
    body.begin_element(element);
    if (&element == &vertex)
      read_vertices(body, element, file.points);
    else if (&element == &face)
      read_faces(body, element, vertex.count, file);
    else
      skip_element(body, element);
  }
  body.finish();
}

std::string kind_of(const PlyElement& element, const PlyProperty& property) {
  static constexpr std::string_view normals[] = {"nx", "ny", "nz"};
  static constexpr std::string_view colours[] = {"red", "green", "blue", "alpha", "r", "g", "b", "a"};
  static constexpr std::string_view textures[] = {"s",         "t",         "u",        "v",
                                                  "texture_u", "texture_v", "texcoord", "texnumber"};
  const auto is_one_of = [&](const auto& names) {
    return std::find(std::begin(names), std::end(names), property.name) != std::end(names);
  };
  if (is_one_of(normals)) return "normals";
  if (is_one_of(colours)) return printable(element.name) + " colours";
  if (is_one_of(textures)) return "texture coordinates";
  return fmt::format("{} property {}", printable(element.name), in_quotes(property.name));
}

std::vector<std::string> kinds_not_kept(const PlyHeader& header, const PlyElement& vertex,
                                        const PlyElement& face) {
  std::vector<std::string> kinds;
  const auto note = [&](const std::string& kind) {
    if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) kinds.push_back(kind);
  };
  for (const PlyElement& element : header.elements) {
    if (&element != &vertex && &element != &face) {
      note(fmt::format("element {}", in_quotes(element.name)));
      continue;
    }
    for (const PlyProperty& property : element.properties) {
      const bool kept = &element == &vertex ? coordinate_of(property) >= 0 : is_index_list(property);
      if (!kept) note(kind_of(element, property));
    }
  }
  return kinds;
}

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

void append_text(std::string& text, Eigen::Ref<const Mat3X> points, const std::vector<Triangle>& triangles) {
  for (Eigen::Index v = 0; v < points.cols(); ++v) {
    append_three(text, points.col(v));
    text += '\n';
  }
  for (const Triangle& triangle : triangles) {
    text += "3 ";
    append_three(text, triangle);
    text += '\n';
  }
}

template <typename T>
void append_bytes(std::string& bytes, T value, bool swap) {
  auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (swap) std::reverse(raw.begin(), raw.end());
  bytes.append(raw.data(), raw.size());
}

void append_binary(std::string& bytes, Eigen::Ref<const Mat3X> points, const std::vector<Triangle>& triangles,
                   bool swap) {
  for (Eigen::Index v = 0; v < points.cols(); ++v)
    for (int k = 0; k < 3; ++k) append_bytes(bytes, points(k, v), swap);
  for (const Triangle& triangle : triangles) {
    bytes += '\3';
    for (const int id : triangle) append_bytes(bytes, id, swap);
  }
}

}  // namespace

MeshFile read_ply(std::string_view bytes, const std::string& name) {
  const PlyHeader header = read_ply_header(bytes, name);
  const PlyElement& vertex = find_element(header, "vertex", name);
  const PlyElement& face = find_element(header, "face", name);
  check_vertex_element(vertex, name);
  check_face_element(face, name);
  MeshFile file;
  file.name = name;
  file.format = "ply";
  file.encoding = header.encoding;
  if (header.encoding == PlyEncoding::ascii)
    read_body(AsciiPlyBody(bytes, name, header), header, vertex, face, file);
  else
    read_body(BinaryPlyBody(bytes, name, header), header, vertex, face, file);
  warn_not_kept(file, kinds_not_kept(header, vertex, face));
  return file;
}

std::string write_ply(Eigen::Ref<const Mat3X> points, const std::vector<Triangle>& triangles,
                      PlyEncoding encoding) {
  const bool ascii = encoding == PlyEncoding::ascii;
  std::string bytes = header_text(points.cols(), triangles.size(), encoding);
  bytes.reserve(bytes.size() + static_cast<size_t>(points.cols()) * (ascii ? 60 : 24) +
                triangles.size() * (ascii ? 24 : 13));
  if (ascii) {
    append_text(bytes, points, triangles);
  } else {
    const bool little = encoding == PlyEncoding::binary_little_endian;
    append_binary(bytes, points, triangles, little != (std::endian::native == std::endian::little));
  }
  return bytes;
}

}  // namespace hooke
