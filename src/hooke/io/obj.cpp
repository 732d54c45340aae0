#include "hooke/io/obj.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <utility>

#include "hooke/core/error.h"
#include "hooke/core/printable.h"
#include "hooke/io/obj_corner_data.h"
#include "hooke/io/scanner.h"
#include "hooke/io/text.h"

namespace hooke {
namespace {

// A kind of content that is ignored.
struct NotKept {
  std::string kind;
  bool unknown = false;
  bool has_shape = false;  // may describe a shape by vertices, which move
  bool operator==(const NotKept&) const = default;
};

// The coordinates of all elements in the text, one column per element.
struct ObjNumbers {
  Mat3X points, texture, normals;
};

// A piece of the text and the content read from it.
struct ObjReader {
  ObjReader(const Scanner& text, ObjNumbers& all)
      : scanner(text),
        vertices{.kind = "vertex", .values = all.points},
        texture{.kind = "texture coordinate", .values = all.texture, .min_numbers = 1},
        normals{.kind = "normal", .values = all.normals} {}

  Scanner scanner;
  MeshFile part{};
  ObjElements vertices, texture, normals;
  std::vector<NotKept> not_kept{};
  std::vector<Vec3> colours{};  // of the vertices that have a colour
  bool continued = false;       // whether the coordinates of a vertex stand on several lines
};

void note(std::vector<NotKept>& noted, NotKept content) {
  constexpr size_t named = 10;  // a file of another format would have hundreds
  if (content.unknown && noted.size() >= named) content.kind = "other unknown statements";
  if (std::ranges::find(noted, content) == noted.end()) noted.push_back(std::move(content));
}

void note(ObjReader& obj, const std::string& kind) {
  note(obj.not_kept, {kind});
}

void read_vertex(ObjReader& obj) {
  Scanner& in = obj.scanner;
  count_one(in, obj.vertices);
  double* coordinate = obj.vertices.values.col(obj.vertices.count - 1).data();
  const int line = in.line();
  for (const char* what : {"x", "y", "z"}) *coordinate++ = in.number(what);
  obj.continued |= in.line() != line;
  int extra = 0;
  Vec3 more = Vec3::Ones();
  for (std::string_view token = in.token(); !token.empty(); token = in.token(), ++extra) {
    const double value = in.number(token, "vertex value");
    if (extra < 3) more[extra] = value;
  }
  if (extra == 1 && more[0] != 1)
    in.fail(fmt::format("vertex weight w is {}; expected 1; rational vertices cannot be read", more[0]));
  if (extra == 2) in.fail("vertex with 5 numbers; expected x y z, x y z w or x y z r g b; correct it");
  if (extra == 3) obj.colours.push_back(more);
  if (extra > 3) note(obj, "vertex colours");
}

int read_corner(ObjReader& obj, std::string_view corner) {
  const Scanner& in = obj.scanner;
  const size_t number = obj.part.polygons.items.size(), first = corner.find('/');
  const int vertex = read_index(in, corner.substr(0, first), corner, obj.vertices);
  if (first == corner.npos) return vertex;
  const std::string_view rest = corner.substr(first + 1);
  const size_t second = rest.find('/');
  const std::string_view texture = rest.substr(0, second);
  if (second == rest.npos || !texture.empty()) read_corner_index(in, texture, corner, number, obj.texture);
  if (second != rest.npos) read_corner_index(in, rest.substr(second + 1), corner, number, obj.normals);
  return vertex;
}

void read_face(ObjReader& obj) {
  Scanner& in = obj.scanner;
  const int line = in.line();
  const size_t before = obj.part.polygons.items.size();
  for (std::string_view token = in.token(); !token.empty(); token = in.token())
    obj.part.polygons.items.push_back(read_corner(obj, token));
  const size_t corners = obj.part.polygons.items.size() - before;
  if (corners < 3)
    in.fail_at(line, fmt::format("face with {} corners; expected 3 or more; correct or remove it", corners));
  obj.part.lines.push_back(line);
  end_polygon(obj.part);
}

void read_other(ObjReader& obj, std::string_view keyword) {
  static constexpr std::pair<std::string_view, const char*> known[] = {
      {"g", "groups"}, {"o", "objects"}, {"usemtl", "materials"}, {"mtllib", "materials"}};
  static constexpr std::pair<std::string_view, const char*> shapes[] = {
      {"vp", "parameter space vertices"}, {"l", "lines"}, {"p", "points"}};
  if (keyword == "s") {
    const std::string_view group = obj.scanner.token();
    if (group != "off" && group != "0") note(obj, "smoothing groups");
    return;
  }
  for (const auto& [word, kind] : known)
    if (keyword == word) return note(obj, kind);
  for (const auto& [word, kind] : shapes)
    if (keyword == word) return note(obj.not_kept, {.kind = kind, .has_shape = true});
  note(obj.not_kept, {.kind = fmt::format("{} statements (line {})", in_quotes(keyword), obj.scanner.line()),
                      .unknown = true,
                      .has_shape = true});
}

void read_statement(ObjReader& obj, std::string_view keyword) {
  if (keyword == "v") {
    read_vertex(obj);
  } else if (keyword == "f" || keyword == "fo") {
    read_face(obj);
  } else if (keyword == "vt") {
    read_numbers(obj.scanner, obj.texture);
  } else if (keyword == "vn") {
    read_numbers(obj.scanner, obj.normals);
  } else {
    read_other(obj, keyword);
  }
}

// Extends the element ids to all corners of the piece (-1 for none), if the text has such elements.
void end_corners(const ObjReader& obj, ObjElements& elements) {
  if (elements.values.cols() > 0) elements.of_corners.resize(obj.part.polygons.items.size(), -1);
}

void read_piece(ObjReader& obj) {
  while (obj.scanner.next_line()) read_statement(obj, obj.scanner.token());
  end_corners(obj, obj.texture);
  end_corners(obj, obj.normals);
}

// Keywords of the elements that faces refer to by number, and their indices in TextPiece::rows_of.
constexpr std::array<std::string_view, 3> numbered = {"v", "vt", "vn"};
enum : size_t { of_vertices, of_texture, of_normals };

// Creates a reader per piece, with the element counts of the pieces before it, and allocates the coordinates.
std::vector<ObjReader> start_readers(const std::vector<TextPiece>& pieces, const std::string& name,
                                     ObjNumbers& all) {
  std::vector<ObjReader> readers;
  long long vertices = 0, texture = 0, normals = 0;
  const auto limited = [](long long count) {  // count_one() throws for larger counts
    return static_cast<int>(std::min<long long>(count, std::numeric_limits<int>::max()));
  };
  for (const TextPiece& piece : pieces) {
    ObjReader& reader = readers.emplace_back(piece.scanner, all);
    reader.part.name = name;
    reader.vertices.count = limited(vertices);
    reader.texture.count = limited(texture);
    reader.normals.count = limited(normals);
    vertices += piece.rows_of[of_vertices];
    texture += piece.rows_of[of_texture];
    normals += piece.rows_of[of_normals];
  }
  all = {Mat3X::Zero(3, limited(vertices)), Mat3X::Zero(3, limited(texture)),
         Mat3X::Zero(3, limited(normals))};
  return readers;
}

ObjElementPieces pieces_of(const std::vector<ObjReader>& readers, const ObjElements ObjReader::*kind) {
  ObjElementPieces pieces;
  for (const ObjReader& reader : readers) pieces.push_back(&(reader.*kind));
  return pieces;
}

// Adds the colours to the vertex data of the file if every vertex has one.
void keep_colours(const std::vector<ObjReader>& readers, MeshFile& file, std::vector<std::string>& not_kept) {
  size_t coloured = 0;
  for (const ObjReader& reader : readers) coloured += reader.colours.size();
  if (coloured == 0) return;
  if (coloured < static_cast<size_t>(file.points.cols())) {
    not_kept.emplace_back("vertex colours");
    return;
  }
  for (size_t k = 0; k < 3; ++k) {
    std::vector<double>& values = file.vertex_data.emplace_back(VertexChannel{colour_names[k]}).values;
    for (const ObjReader& reader : readers)
      for (const Vec3& colour : reader.colours) values.push_back(colour[static_cast<Eigen::Index>(k)]);
  }
}

constexpr CornerDataKind texture_kind = {.channels = texture_names,
                                         .type = NumberType::float64,
                                         .what = "texture coordinates",
                                         .element = "vt",
                                         .seams = "seams",
                                         .code = "texture_seams"};
constexpr CornerDataKind normal_kind = {
    .channels = normal_names,
    .type = NumberType::float32,  // recomputed on output, so single precision suffices
    .what = "normals",
    .element = "vn",
    .seams = "hard edges",
    .code = "hard_edges"};

// The kinds of content that is ignored, in the order of the text.
std::vector<NotKept> all_ignored(const std::vector<ObjReader>& readers) {
  std::vector<NotKept> noted;
  for (const ObjReader& reader : readers)
    for (const NotKept& content : reader.not_kept) note(noted, content);
  return noted;
}

// The whole content of a text. Movable, although its readers refer to the numbers.
struct ObjContent {
  MeshFile file;  // points and polygons
  std::unique_ptr<ObjNumbers> numbers;
  std::vector<ObjReader> readers;
};

ObjContent read_content(std::string_view text, const std::string& name) {
  ObjContent content{{}, std::make_unique<ObjNumbers>(), {}};
  content.file.name = name;
  content.file.format = MeshFormat::obj;
  const std::vector<TextPiece> pieces = remaining_pieces(Scanner(text, name, obj_syntax), numbered);
  std::vector<ObjReader>& readers = content.readers = start_readers(pieces, name, *content.numbers);
  read_pieces(pieces, [&](const TextPiece&, size_t p) { read_piece(readers[p]); });
  for (const auto kind : {&ObjReader::vertices, &ObjReader::texture, &ObjReader::normals})
    check_max_index(name, pieces_of(readers, kind));
  if (content.numbers->points.cols() == 0)
    throw InputError(name + ": no vertices; expected v lines; is this an OBJ file?");
  content.file.points = std::move(content.numbers->points);
  std::vector<MeshFile> parts;
  for (ObjReader& reader : readers) parts.push_back(std::move(reader.part));
  append_faces(content.file, parts);
  return content;
}

}  // namespace

MeshFile read_obj(std::string_view text, const std::string& name) {
  ObjContent content = read_content(text, name);
  MeshFile& file = content.file;
  std::vector<std::string> not_kept;
  keep_colours(content.readers, file, not_kept);
  keep_elements(pieces_of(content.readers, &ObjReader::texture), texture_kind, file, not_kept);
  keep_elements(pieces_of(content.readers, &ObjReader::normals), normal_kind, file, not_kept);
  std::vector<std::string> shapes;
  for (const NotKept& ignored : all_ignored(content.readers)) {
    if (std::ranges::find(not_kept, ignored.kind) == not_kept.end()) not_kept.push_back(ignored.kind);
    if (ignored.has_shape) shapes.push_back(ignored.kind);
  }
  warn_not_kept(file, not_kept);
  warn_carried_along(file, shapes);
  if (std::ranges::any_of(content.readers, &ObjReader::continued))
    file.misread = "vertices whose lines are continued by '\\'";
  return std::move(file);
}

ObjCorners read_obj_corners(std::string_view text, const std::string& name) {
  ObjContent content = read_content(text, name);
  const auto corners = [&](Mat3X& values, ObjElements ObjReader::*kind) {
    ObjCornerData data{std::move(values), {}};
    for (const ObjReader& reader : content.readers)
      data.of_corners.insert(data.of_corners.end(), (reader.*kind).of_corners.begin(),
                             (reader.*kind).of_corners.end());
    return data;
  };
  return {std::move(content.file.points), std::move(content.file.polygons),
          corners(content.numbers->texture, &ObjReader::texture),
          corners(content.numbers->normals, &ObjReader::normals)};
}

std::string write_obj(Eigen::Ref<const Mat3X> points, const std::vector<Triangle>& triangles,
                      const VertexData& data) {
  const ChannelList texture = channels_named(data, texture_names);
  const ChannelList normals = channels_named(data, normal_names);
  std::vector<const char*> repeats;  // indices of vt and vn, equal to that of the vertex
  if (!texture.empty()) repeats.push_back("/");
  if (!normals.empty()) repeats.push_back(texture.empty() ? "//" : "/");
  std::string text;
  append_vertex_rows(text, points, "v ", channels_named(data, colour_names));
  append_value_rows(text, "vt", texture);
  append_value_rows(text, "vn", normals);
  append_face_rows(text, triangles, "f", 1, repeats);
  return text;
}

}  // namespace hooke
