#include "hooke/io/ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "hooke/core/error.h"
#include "hooke/core/printable.h"
#include "hooke/io/binary_numbers.h"
#include "hooke/io/ply_format.h"
#include "hooke/io/text.h"

namespace hooke {
namespace {

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
  const auto lists = std::count_if(face.properties.begin(), face.properties.end(), is_corner_list);
  const auto usable =
      std::count_if(face.properties.begin(), face.properties.end(), [](const PlyProperty& property) {
        return is_corner_list(property) && property.count_type && is_integer(property.type);
      });
  if (lists != 1 || usable != 1)
    throw InputError(fmt::format(
        "{}: faces without one integer list 'vertex_indices'; expected it once; correct the header", name));
}

// Allocates the vertices and their data.
void allocate_vertices(const PlyElement& vertex, MeshFile& file) {
  file.points.resize(3, vertex.count);
  for (const PlyProperty& property : vertex.properties)
    if (coordinate_of(property) < 0 && !property.count_type)
      file.vertex_data.push_back({property.name, property.type, std::vector<double>(vertex.count)});
}

template <typename Body>
void read_vertices(Body& body, const PlyElement& vertex, const PlyRows& rows, MeshFile& file) {
  static constexpr const char* names[] = {"x", "y", "z"};
  for (long long row = rows.begin; row < rows.end; ++row) {
    body.begin_row(vertex, row);
    auto channel = file.vertex_data.begin();
    for (const PlyProperty& property : vertex.properties) {
      const int k = coordinate_of(property);
      if (k >= 0)
        file.points(k, row) = body.number(property.type, names[k]);
      else if (property.count_type)
        skip_property(body, property);
      else
        (channel++)->values[row] = body.any_number(property.type, property.name);
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

// Whether the faces' property is kept as face data.
bool is_label(const PlyProperty& property) {
  return !property.count_type && is_integer(property.type) && !is_corner_list(property);
}

bool is_colour(const std::string& name) {
  static constexpr std::string_view colours[] = {"red", "green", "blue", "alpha", "r", "g", "b", "a"};
  return std::find(std::begin(colours), std::end(colours), name) != std::end(colours);
}

// Adds a channel for each integer property of the faces.
void add_labels(const PlyElement& face, MeshFile& file) {
  for (const PlyProperty& property : face.properties)
    if (is_label(property))
      file.face_data.push_back(
          {property.name,
           {},
           {},
           is_colour(property.name) || property.name == "flags" ? LabelKind::other : LabelKind::material,
           property.type});
}

template <typename Body>
void read_faces(Body& body, const PlyElement& face, const PlyRows& rows, long long vertex_count,
                MeshFile& file) {
  for (long long row = rows.begin; row < rows.end; ++row) {
    body.begin_row(face, row);
    if (body.line() > 0) file.lines.push_back(body.line());
    auto channel = file.face_data.begin();
    for (const PlyProperty& property : face.properties) {
      if (is_corner_list(property))
        read_corners(body, property, vertex_count, file);
      else if (is_label(property))
        (channel++)->values.push_back(
            static_cast<int>(static_cast<std::uint32_t>(body.integer(property.type, property.name.c_str()))));
      else
        skip_property(body, property);
    }
    body.end_row();
    end_polygon(file);
  }
}

// The header and its elements for vertices and faces.
struct Elements {
  const PlyHeader& header;
  const PlyElement& vertex;
  const PlyElement& face;
};

// Stores vertices at their indices in `file` and appends faces to `part`.
template <typename Body>
void read_rows(Body& body, const Elements& elements, const PlyElement& element, const PlyRows& rows,
               MeshFile& file, MeshFile& part) {
  if (&element == &elements.vertex)
    read_vertices(body, element, rows, file);
  else if (&element == &elements.face)
    read_faces(body, element, rows, elements.vertex.count, part);
  else
    skip_rows(body, element, rows);
}

template <typename Body>
void read_body(Body body, const Elements& elements, MeshFile& file) {
  for (const PlyElement& element : elements.header.elements) {
    body.begin_element(element);
    if (&element == &elements.vertex) allocate_vertices(element, file);
    read_rows(body, elements, element, {0, row_count(element)}, file, file);
  }
  body.finish();
}

// Reads a body with exactly as many lines as the header announces, in parallel pieces.
void read_pieces_of_body(const std::vector<TextPiece>& pieces, const Elements& elements, MeshFile& file) {
  allocate_vertices(elements.vertex, file);
  std::vector<MeshFile> parts(pieces.size());
  read_pieces(pieces, [&](const TextPiece& piece, size_t p) {
    AsciiPlyBody body(piece.scanner);
    parts[p].name = file.name;
    add_labels(elements.face, parts[p]);
    for_rows_of_piece(elements.header, piece, [&](const PlyElement& element, const PlyRows& rows) {
      read_rows(body, elements, element, rows, file, parts[p]);
    });
  });
  append_faces(file, parts);
  for (size_t c = 0; c < file.face_data.size(); ++c)
    for (const MeshFile& part : parts) {
      std::vector<int>& all = file.face_data[c].values;
      const std::vector<int>& more = part.face_data[c].values;
      all.insert(all.end(), more.begin(), more.end());
    }
}

void read_ascii_body(AsciiPlyBody body, const Elements& elements, MeshFile& file) {
  if (body.one_line()) return read_body(std::move(body), elements, file);
  const std::vector<TextPiece> pieces = remaining_pieces(body.scanner());
  const long long there = pieces.empty() ? 0 : pieces.back().first_row + pieces.back().rows;
  double expected = 0;  // a double, as counts from the header may overflow an integer
  for (const PlyElement& element : elements.header.elements)
    expected += static_cast<double>(row_count(element));
  if (static_cast<double>(there) == expected)
    read_pieces_of_body(pieces, elements, file);
  else
    read_body(std::move(body), elements, file);  // reports the position of the error
}

std::string kind_of(const PlyElement& element, const PlyProperty& property) {
  static constexpr std::string_view normals[] = {"nx", "ny", "nz"};
  static constexpr std::string_view textures[] = {"s",         "t",         "u",        "v",
                                                  "texture_u", "texture_v", "texcoord", "texnumber"};
  const auto is_one_of = [&](const auto& names) {
    return std::find(std::begin(names), std::end(names), property.name) != std::end(names);
  };
  if (is_one_of(normals)) return "normals";
  if (is_colour(property.name)) return printable(element.name) + " colours";
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
      const bool kept =
          &element == &vertex ? !property.count_type : is_corner_list(property) || is_label(property);
      if (!kept) note(kind_of(element, property));
    }
  }
  return kinds;
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
  file.format = MeshFormat::ply;
  file.encoding = header.encoding;
  add_labels(face, file);
  if (header.encoding == PlyEncoding::ascii)
    read_ascii_body(AsciiPlyBody(bytes, name, header), {header, vertex, face}, file);
  else
    read_body(BinaryPlyBody(bytes, name, header), {header, vertex, face}, file);
  warn_not_kept(file, kinds_not_kept(header, vertex, face));
  return file;
}

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

std::string properties_of(const VertexData& data) {
  std::string lines;
  for (const VertexChannel& channel : data)
    lines += fmt::format("property {} {}\n", name_of(channel.type), channel.name);
  return lines;
}

std::string header_text(Eigen::Index vertices, size_t faces, PlyEncoding encoding, const VertexData& data,
                        const VertexData& face_data) {
  return fmt::format(
      "ply\nformat {} 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n{}"
      "element face {}\nproperty list uchar int vertex_indices\n{}end_header\n",
      name_of(encoding), vertices, properties_of(data), faces, properties_of(face_data));
}

size_t row_size(const VertexData& data) {
  size_t size = 0;
  for (const VertexChannel& channel : data) size += size_of(channel.type);
  return size;
}

void append_binary(std::string& bytes, const Eigen::Ref<const Mat3X>& points,
                   const std::vector<Triangle>& triangles, const VertexData& data,
                   const VertexData& face_data, bool swap) {
  const size_t vertex_size = 3 * sizeof(double) + row_size(data),
               face_size = 1 + 3 * sizeof(int) + row_size(face_data);
  const size_t header = bytes.size();
  bytes.resize(header + static_cast<size_t>(points.cols()) * vertex_size + triangles.size() * face_size);
  char* at = bytes.data() + header;
  const auto put_row = [&](const VertexData& channels, size_t row) {
    for (const VertexChannel& channel : channels) put_binary(at, channel.type, channel.values[row], swap);
  };
  for (Eigen::Index v = 0; v < points.cols(); ++v) {
    for (int k = 0; k < 3; ++k) put_binary(at, PlyType::float64, points(k, v), swap);
    put_row(data, v);
  }
  for (size_t f = 0; f < triangles.size(); ++f) {
    *at++ = 3;
    for (const int id : triangles[f]) put_binary(at, PlyType::int32, id, swap);
    put_row(face_data, f);
  }
}

}  // namespace

VertexData ply_face_data(const FaceData& data) {
  VertexData result;
  for (const FaceChannel& channel : data) {
    std::vector<double>& values = result.emplace_back(VertexChannel{channel.name, channel.type}).values;
    values.reserve(channel.values.size());
    for (const int value : channel.values)
      values.push_back(channel.type == NumberType::uint32
                           ? static_cast<double>(static_cast<std::uint32_t>(value))
                           : static_cast<double>(value));
  }
  return result;
}

std::string write_ply(const Eigen::Ref<const Mat3X>& points, const std::vector<Triangle>& triangles,
                      PlyEncoding encoding, const VertexData& data, const VertexData& face_data) {
  const bool ascii = encoding == PlyEncoding::ascii;
  std::string bytes = header_text(points.cols(), triangles.size(), encoding, data, face_data);
  if (ascii) {
    const auto list_of = [](const VertexData& channels) {
      ChannelList list;
      for (const VertexChannel& channel : channels) list.push_back(&channel);
      return list;
    };
    append_vertex_rows(bytes, points, "", list_of(data));
    append_face_rows(bytes, triangles, "3", 0, {}, list_of(face_data));
  } else {
    append_binary(bytes, points, triangles, data, face_data, swaps_bytes(encoding));
  }
  return bytes;
}

namespace {

bool is_length(const PlyProperty& property) {
  const bool is_coordinate = property.name == "x" || property.name == "y" || property.name == "z";
  return !property.count_type && !is_integer(property.type) && !is_coordinate;
}

void require_length_property(const PlyElement& vertex, const std::string& property, const std::string& name) {
  std::string there;
  for (const PlyProperty& p : vertex.properties) {
    if (!is_length(p)) continue;
    if (p.name == property) return;
    there += (there.empty() ? " " : ", ") + in_quotes(p.name);
  }
  throw InputError(fmt::format(
      "{}: vertices have no float or double property {}; expected one of target lengths; there {}", name,
      in_quotes(property), there.empty() ? "is none" : "are" + there));
}

template <typename Body>
std::vector<double> read_lengths(Body body, const PlyHeader& header, const PlyElement& vertex,
                                 const std::string& property_name) {
  for (const PlyElement& element : header.elements) {
    body.begin_element(element);
    if (&element == &vertex) break;
    skip_element(body, element);
  }
  std::vector<double> lengths;
  lengths.reserve(vertex.count);
  for (long long row = 0; row < vertex.count; ++row) {
    body.begin_row(vertex, row);
    for (const PlyProperty& property : vertex.properties) {
      if (property.name != property_name) {
        skip_property(body, property);
        continue;
      }
      const double length = body.number(property.type, "target length");
      if (!(length > 0))
        body.fail(fmt::format("target length {}; expected a positive number; correct it", length));
      lengths.push_back(length);
    }
    body.end_row();
  }
  return lengths;
}

}  // namespace

std::vector<double> read_ply_lengths(std::string_view bytes, const std::string& name,
                                     const std::string& property) {
  const PlyHeader header = read_ply_header(bytes, name);
  const PlyElement& vertex = find_element(header, "vertex", name);
  require_length_property(vertex, property, name);
  if (header.encoding == PlyEncoding::ascii)
    return read_lengths(AsciiPlyBody(bytes, name, header), header, vertex, property);
  return read_lengths(BinaryPlyBody(bytes, name, header), header, vertex, property);
}

}  // namespace hooke
