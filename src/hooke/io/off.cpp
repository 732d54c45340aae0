#include "hooke/io/off.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "hooke/io/binary_off.h"
#include "hooke/io/off_format.h"
#include "hooke/io/scanner.h"
#include "hooke/io/text.h"

namespace hooke {
namespace {

// Reads a vertex line and stores the numbers after the coordinates in the channels of `data`, as many as
// there are. Returns the count of these numbers.
int read_vertex(Scanner& in, double* coordinates, VertexData& data, size_t vertex) {
  for (const char* what : {"x", "y", "z"}) *coordinates++ = in.number(what);
  size_t extra = 0;
  for (std::string_view token = in.token(); !token.empty(); token = in.token(), ++extra) {
    const double value = in.number(token, "vertex value");
    if (extra < data.size()) data[extra].values[vertex] = value;
  }
  return static_cast<int>(extra);
}

// The count of numbers after the coordinates on the first vertex line, which determines that of all vertices.
int numbers_after_coordinates(const std::vector<TextPiece>& pieces, const OffHeader& header) {
  if (header.vertices == 0 || pieces.empty()) return 0;
  const auto first = std::ranges::find_if(pieces, [](const TextPiece& piece) { return piece.rows > 0; });
  if (first == pieces.end()) return 0;
  Scanner in = first->scanner;
  in.next_line();
  double coordinates[3];
  VertexData none;
  return read_vertex(in, coordinates, none, 0);
}

// Allocates the channels that the keyword announces, in file order. Returns none unless they take exactly
// `extra` numbers per vertex.
VertexData allocate_data(const OffHeader& header, int extra, size_t vertices) {
  const int colours = extra - (header.normals ? 3 : 0) - (header.texture ? 2 : 0);
  if (header.colours ? colours != 3 && colours != 4 : colours != 0) return {};
  VertexData data;
  const auto add = [&](ChannelNames names, NumberType type) {
    for (const char* name : names) data.push_back({name, type, std::vector<double>(vertices)});
  };
  if (header.normals) add(normal_names, NumberType::float32);
  add(ChannelNames(colour_names).first(colours), NumberType::float64);
  if (header.texture) add(ChannelNames(texture_names).first(2), NumberType::float64);
  return data;
}

// Colours are 8-bit integers if all are integers up to 255, unless all are 0 or 1.
void find_type_of_colours(VertexData& data) {
  double maximum = 0;
  for (const VertexChannel* channel : channels_named(data, colour_names))
    for (const double value : channel->values) {
      if (value != std::round(value) || value < 0 || value > 255) return;
      maximum = std::max(maximum, value);
    }
  if (maximum <= 1) return;
  for (const char* name : colour_names)
    if (VertexChannel* channel = find_channel(data, name)) channel->type = NumberType::uint8;
}

void check_vertex(const Scanner& in, const OffHeader& header, int vertex, int extra, int expected_extra) {
  if (extra != expected_extra)
    in.fail(fmt::format(
        "vertex {} with {} numbers; expected {} as on the first vertex line; is the vertex count right?",
        vertex, 3 + extra, 3 + expected_extra));
  const int by_keyword = (header.normals ? 3 : 0) + (header.colours ? 1 : 0) + (header.texture ? 2 : 0);
  if (vertex == header.vertices - 1 && extra < by_keyword)
    in.fail(fmt::format("vertices have {} numbers; expected at least {} by the keyword; correct the keyword",
                        3 + extra, 3 + by_keyword));
}

// Reads a face line. Returns whether it ends with a colour.
bool read_face(Scanner& in, int face, int vertex_count, MeshFile& part) {
  const long long corners = in.integer("face size");
  if (corners < 3)
    in.fail(fmt::format("face {} with {} corners; expected 3 or more; correct or remove it", face, corners));
  for (long long k = 0; k < corners; ++k) {
    const long long id = in.integer("face corner");
    if (id < 0 || id >= vertex_count)
      in.fail(fmt::format("face {} has vertex index {}; expected 0 to {}; correct the index", face, id,
                          vertex_count - 1));
    part.polygons.items.push_back(static_cast<int>(id));
  }
  int extra = 0;
  for (std::string_view token = in.token(); !token.empty(); token = in.token(), ++extra)
    in.number(token, "face colour");
  if (extra == 2 || extra > 4)
    in.fail(fmt::format(
        "{} numbers after face {}; expected a colour of 1, 3 or 4, or none; is the face size right?", extra,
        face));
  part.lines.push_back(in.line());
  end_polygon(part);
  return extra > 0;
}

std::vector<std::string> kinds_not_kept(const OffHeader& header, int vertex_extra, bool kept,
                                        bool face_colours) {
  std::vector<std::string> kinds;
  if (!kept && header.normals) kinds.emplace_back("normals");
  if (!kept && header.colours) kinds.emplace_back("vertex colours");
  if (!kept && header.texture) kinds.emplace_back("texture coordinates");
  if (!kept && kinds.empty() && vertex_extra > 0)
    kinds.push_back(fmt::format("{} more numbers on each vertex line", vertex_extra));
  if (face_colours) kinds.emplace_back("face colours");
  return kinds;
}

// Throws the error for a text that ends before all elements.
[[noreturn]] void fail_at_end(Scanner in, const OffHeader& header, long long rows) {
  while (in.next_line()) continue;
  const bool vertex = rows < header.vertices;
  in.fail(
      fmt::format("the file ends before {} {} of {} (counted from 0); the file is cut or the count is wrong",
                  vertex ? "vertex" : "face", vertex ? rows : rows - header.vertices,
                  vertex ? header.vertices : header.faces));
}

}  // namespace

MeshFile read_off(std::string_view text, const std::string& name) {
  Scanner in(text, name, off_syntax);
  const OffHeader header = read_off_header(in);
  if (header.binary) return read_binary_off(text, name);
  const std::vector<TextPiece> pieces = remaining_pieces(in);
  const long long rows = pieces.empty() ? 0 : pieces.back().first_row + pieces.back().rows;
  const long long elements = static_cast<long long>(header.vertices) + header.faces;
  const int extra = numbers_after_coordinates(pieces, header);
  MeshFile file;
  file.name = name;
  file.format = MeshFormat::off;
  file.points.resize(3, std::min<long long>(rows, header.vertices));
  file.vertex_data = allocate_data(header, extra, file.points.cols());
  std::vector<MeshFile> parts(pieces.size());
  std::vector<char> face_colours(pieces.size(), 0);
  read_pieces(pieces, [&](const TextPiece& piece, size_t p) {
    Scanner rest = piece.scanner;
    parts[p].name = name;
    for (long long row = piece.first_row; rest.next_line(); ++row) {
      if (row < header.vertices) {
        const int found = read_vertex(rest, file.points.col(row).data(), file.vertex_data, row);
        check_vertex(rest, header, static_cast<int>(row), found, extra);
      } else if (row < elements) {
        const int face = static_cast<int>(row - header.vertices);
        face_colours[p] |= static_cast<char>(read_face(rest, face, header.vertices, parts[p]));
      } else {
        rest.fail(fmt::format(
            "text after the last of {} faces; expected the end of the file; is the face count right?",
            header.faces));
      }
    }
  });
  if (rows < elements) fail_at_end(pieces.empty() ? in : pieces.back().scanner, header, rows);
  append_faces(file, parts);
  const bool any_face_colour = std::ranges::find(face_colours, 1) != face_colours.end();
  find_type_of_colours(file.vertex_data);
  warn_not_kept(file, kinds_not_kept(header, extra, !file.vertex_data.empty(), any_face_colour));
  return file;
}

std::string write_off(const Eigen::Ref<const Mat3X>& points, const std::vector<Triangle>& triangles,
                      const VertexData& data) {
  const ChannelList normals = channels_named(data, normal_names);
  const ChannelList colours = channels_named(data, colour_names);
  const ChannelList texture = channels_named(data, texture_names);
  ChannelList channels;
  for (const ChannelList* list : {&normals, &colours, &texture})
    channels.insert(channels.end(), list->begin(), list->end());
  std::string text =
      fmt::format("{}{}{}OFF\n{} {} 0\n", texture.empty() ? "" : "ST", colours.empty() ? "" : "C",
                  normals.empty() ? "" : "N", points.cols(), triangles.size());
  append_vertex_rows(text, points, "", channels);
  append_face_rows(text, triangles, "3", 0);
  return text;
}

}  // namespace hooke
