#include "hooke/io/obj.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "hooke/error.h"
#include "hooke/io/printable.h"
#include "hooke/io/scanner.h"
#include "hooke/io/text_pieces.h"
#include "hooke/io/text_rows.h"

namespace hooke {
namespace {

// Elements of one kind that faces refer to: vertices, texture coordinates or normals.
struct Referred {
  const char* kind;
  int count = 0;      // so far in the text
  int greatest = -1;  // 0-based index that a face asked for
  int greatest_line = 0;
};

// A kind of content that is passed over.
struct NotKept {
  std::string kind;
  bool unknown = false;
  bool operator==(const NotKept&) const = default;
};

// A piece of the text, and what was read from it.
struct ObjReader {
  Scanner scanner;
  Mat3X& points;  // of the whole text
  MeshFile part{};
  Referred vertices{"vertex"}, texture{"texture coordinate"}, normals{"normal"};
  std::vector<NotKept> not_kept{};
  std::vector<Vec3> colours{};  // of the vertices that have one
};

void note(std::vector<NotKept>& noted, NotKept content) {
  constexpr size_t named = 10;  // a file of another kind would name hundreds
  if (content.unknown && noted.size() >= named) content.kind = "other unknown statements";
  if (std::ranges::find(noted, content) == noted.end()) noted.push_back(std::move(content));
}

void note(ObjReader& obj, const std::string& kind) {
  note(obj.not_kept, {kind});
}

void count_one(const Scanner& scanner, Referred& elements) {
  if (elements.count == std::numeric_limits<int>::max())
    scanner.fail("too many elements; expected at most 2147483647 of a kind; split the mesh");
  ++elements.count;
}

void read_vertex(ObjReader& obj) {
  Scanner& in = obj.scanner;
  count_one(in, obj.vertices);
  double* coordinate = obj.points.col(obj.vertices.count - 1).data();
  for (const char* what : {"x", "y", "z"}) *coordinate++ = in.number(what);
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

// 0-based id of `text`, the index of one of `elements` in the face corner `corner`.
int read_index(const Scanner& in, std::string_view text, std::string_view corner, Referred& elements) {
  long long index = 0;
  const NumberError error = parse_integer(text, index);
  if (error == NumberError::malformed)
    in.fail(fmt::format("face corner {}; expected v, v/vt, v//vn or v/vt/vn with integers; correct it",
                        in_quotes(corner)));
  if (error == NumberError::too_large || index > std::numeric_limits<int>::max() || index < -elements.count)
    in.fail(fmt::format("{} index {} where {} were read so far; expected an existing one; correct the index",
                        elements.kind, printable(text), elements.count));
  if (index == 0)
    in.fail(
        fmt::format("{} index 0; expected 1 or more, or a negative one; OBJ counts from 1", elements.kind));
  const int id = static_cast<int>(index > 0 ? index - 1 : elements.count + index);
  if (id > elements.greatest) {
    elements.greatest = id;
    elements.greatest_line = in.line();
  }
  return id;
}

int read_corner(ObjReader& obj, std::string_view corner) {
  const size_t first = corner.find('/');
  const int vertex = read_index(obj.scanner, corner.substr(0, first), corner, obj.vertices);
  if (first == corner.npos) return vertex;
  const std::string_view rest = corner.substr(first + 1);
  const size_t second = rest.find('/');
  const std::string_view texture = rest.substr(0, second);
  if (second == rest.npos || !texture.empty()) read_index(obj.scanner, texture, corner, obj.texture);
  if (second != rest.npos) read_index(obj.scanner, rest.substr(second + 1), corner, obj.normals);
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
  static constexpr std::pair<std::string_view, const char*> known[] = {{"vp", "parameter space vertices"},
                                                                       {"g", "groups"},
                                                                       {"o", "objects"},
                                                                       {"usemtl", "materials"},
                                                                       {"mtllib", "materials"},
                                                                       {"l", "lines"},
                                                                       {"p", "points"}};
  if (keyword == "s") {
    const std::string_view group = obj.scanner.token();
    if (group != "off" && group != "0") note(obj, "smoothing groups");
    return;
  }
  for (const auto& [word, kind] : known)
    if (keyword == word) return note(obj, kind);
  note(obj.not_kept, {.kind = fmt::format("{} statements (line {})", in_quotes(keyword), obj.scanner.line()),
                      .unknown = true});
}

void read_statement(ObjReader& obj, std::string_view keyword) {
  if (keyword == "v") {
    read_vertex(obj);
  } else if (keyword == "f" || keyword == "fo") {
    read_face(obj);
  } else if (keyword == "vt") {
    count_one(obj.scanner, obj.texture);
    note(obj, "texture coordinates");
  } else if (keyword == "vn") {
    count_one(obj.scanner, obj.normals);
    note(obj, "normals");
  } else {
    read_other(obj, keyword);
  }
}

// How many elements faces can refer to.
struct Counts {
  int vertices = 0, texture = 0, normals = 0;
};

Counts count_elements(Scanner in) {
  Counts counts;
  while (in.next_line()) {
    const std::string_view keyword = in.token();
    counts.vertices += keyword == "v";
    counts.texture += keyword == "vt";
    counts.normals += keyword == "vn";
  }
  return counts;
}

// Readers of the pieces, each of which knows how much stands before it; makes room for the points.
std::vector<ObjReader> start_readers(const std::vector<TextPiece>& pieces, const std::string& name,
                                     Mat3X& points) {
  std::vector<Counts> counts(pieces.size());
  read_pieces(pieces, [&](const TextPiece& piece, size_t p) { counts[p] = count_elements(piece.scanner); });
  std::vector<ObjReader> readers;
  long long vertices = 0, texture = 0, normals = 0;
  const auto limited = [](long long count) {  // count_one() refuses what is beyond
    return static_cast<int>(std::min<long long>(count, std::numeric_limits<int>::max()));
  };
  for (size_t p = 0; p < pieces.size(); ++p) {
    ObjReader& reader = readers.emplace_back(ObjReader{pieces[p].scanner, points});
    reader.part.name = name;
    reader.vertices.count = limited(vertices);
    reader.texture.count = limited(texture);
    reader.normals.count = limited(normals);
    vertices += counts[p].vertices;
    texture += counts[p].texture;
    normals += counts[p].normals;
  }
  points.resize(3, limited(vertices));
  return readers;
}

// Positive indices may point forward, so their upper bound is known only at the end.
void check_greatest(const std::vector<ObjReader>& readers, const Referred ObjReader::*kind) {
  const ObjReader* greatest = &readers.front();
  for (const ObjReader& reader : readers)
    if ((reader.*kind).greatest > (greatest->*kind).greatest) greatest = &reader;
  const Referred& elements = greatest->*kind;
  const int count = (readers.back().*kind).count;
  if (elements.greatest >= count)
    greatest->scanner.fail_at(
        elements.greatest_line,
        fmt::format("{} index {}; expected at most {}, the number in the file; correct the index",
                    elements.kind, elements.greatest + 1LL, count));
}

// The colours as channels where every vertex has one.
VertexData collect_colours(std::vector<ObjReader>& readers, size_t vertices) {
  size_t coloured = 0;
  for (const ObjReader& reader : readers) coloured += reader.colours.size();
  if (coloured == 0) return {};
  if (coloured < vertices) {
    note(readers.front(), "vertex colours");
    return {};
  }
  VertexData data = {{.name = "red"}, {.name = "green"}, {.name = "blue"}};
  for (size_t k = 0; k < 3; ++k)
    for (const ObjReader& reader : readers)
      for (const Vec3& colour : reader.colours)
        data[k].values.push_back(colour[static_cast<Eigen::Index>(k)]);
  return data;
}

std::vector<std::string> kinds_not_kept(const std::vector<ObjReader>& readers) {
  std::vector<NotKept> noted;
  for (const ObjReader& reader : readers)
    for (const NotKept& content : reader.not_kept) note(noted, content);
  std::vector<std::string> kinds;
  for (NotKept& content : noted) kinds.push_back(std::move(content.kind));
  return kinds;
}

}  // namespace

MeshFile read_obj(std::string_view text, const std::string& name) {
  MeshFile file;
  file.name = name;
  file.format = "obj";
  const std::vector<TextPiece> pieces =
      remaining_pieces(Scanner(text, name, {.comments = true, .continuations = true}));
  std::vector<ObjReader> readers = start_readers(pieces, name, file.points);
  read_pieces(pieces, [&](const TextPiece&, size_t p) {
    Scanner& in = readers[p].scanner;
    while (in.next_line()) read_statement(readers[p], in.token());
  });
  if (!readers.empty())
    for (const auto kind : {&ObjReader::vertices, &ObjReader::texture, &ObjReader::normals})
      check_greatest(readers, kind);
  if (file.points.cols() == 0)
    throw InputError(name + ": no vertices; expected v lines; is this an OBJ file?");
  file.vertex_data = collect_colours(readers, static_cast<size_t>(file.points.cols()));
  std::vector<MeshFile> parts;
  for (ObjReader& reader : readers) parts.push_back(std::move(reader.part));
  append_faces(file, parts);
  warn_not_kept(file, kinds_not_kept(readers));
  return file;
}

std::string write_obj(Eigen::Ref<const Mat3X> points, const std::vector<Triangle>& triangles,
                      const VertexData& data) {
  std::string text;
  append_vertex_rows(text, points, "v ", data);
  append_face_rows(text, triangles, "f ", 1);
  return text;
}

}  // namespace hooke
