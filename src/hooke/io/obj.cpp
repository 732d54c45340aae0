#include "hooke/io/obj.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "hooke/error.h"
#include "hooke/io/append_number.h"
#include "hooke/io/printable.h"
#include "hooke/io/scanner.h"

namespace hooke {
namespace {

// Elements of one kind that faces refer to: vertices, texture coordinates or normals.
struct Referred {
  const char* kind;
  int count = 0;      // so far
  int greatest = -1;  // 0-based index that a face asked for
  int greatest_line = 0;
};

struct ObjReader {
  Scanner scanner;
  MeshFile file{};
  std::vector<double> coordinates{};
  Referred vertices{"vertex"}, texture{"texture coordinate"}, normals{"normal"};
  std::vector<std::string> not_kept{};
};

void note(ObjReader& obj, const std::string& kind) {
  if (std::find(obj.not_kept.begin(), obj.not_kept.end(), kind) == obj.not_kept.end())
    obj.not_kept.push_back(kind);
}

void count_one(const Scanner& scanner, Referred& elements) {
  if (elements.count == std::numeric_limits<int>::max())
    scanner.fail("too many elements; expected at most 2147483647 of a kind; split the mesh");
  ++elements.count;
}

void read_vertex(ObjReader& obj) {
  Scanner& in = obj.scanner;
  for (const char* what : {"x", "y", "z"}) obj.coordinates.push_back(in.number(what));
  count_one(in, obj.vertices);
  int extra = 0;
  double fourth = 1;
  for (std::string_view token = in.token(); !token.empty(); token = in.token(), ++extra) {
    const double value = in.number(token, "vertex value");
    if (extra == 0) fourth = value;
  }
  if (extra == 1 && fourth != 1)
    in.fail(fmt::format("vertex weight w is {}; expected 1; rational vertices cannot be read", fourth));
  if (extra == 2) in.fail("vertex with 5 numbers; expected x y z, x y z w or x y z r g b; correct it");
  if (extra > 2) note(obj, "vertex colours");
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
  const size_t before = obj.file.polygons.items.size();
  for (std::string_view token = in.token(); !token.empty(); token = in.token())
    obj.file.polygons.items.push_back(read_corner(obj, token));
  const size_t corners = obj.file.polygons.items.size() - before;
  if (corners < 3)
    in.fail_at(line, fmt::format("face with {} corners; expected 3 or more; correct or remove it", corners));
  obj.file.lines.push_back(line);
  end_polygon(obj.file);
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
  constexpr size_t named = 10;  // a file of another kind would name hundreds
  if (obj.not_kept.size() < named)
    note(obj, fmt::format("{} statements (line {})", in_quotes(keyword), obj.scanner.line()));
  else
    note(obj, "other unknown statements");
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

// Positive indices may point forward, so their upper bound is known only at the end.
void check_greatest(const Scanner& in, const Referred& elements) {
  if (elements.greatest >= elements.count)
    in.fail_at(elements.greatest_line,
               fmt::format("{} index {}; expected at most {}, the number in the file; correct the index",
                           elements.kind, elements.greatest + 1LL, elements.count));
}

}  // namespace

MeshFile read_obj(std::string_view text, const std::string& name) {
  ObjReader obj{Scanner(text, name, {.comments = true, .continuations = true})};
  obj.file.name = name;
  obj.file.format = "obj";
  while (obj.scanner.next_line()) read_statement(obj, obj.scanner.token());
  for (const Referred* elements : {&obj.vertices, &obj.texture, &obj.normals})
    check_greatest(obj.scanner, *elements);
  if (obj.vertices.count == 0)
    throw InputError(name + ": no vertices; expected v lines; is this an OBJ file?");
  obj.file.points = Eigen::Map<const Mat3X>(obj.coordinates.data(), 3, obj.vertices.count);
  warn_not_kept(obj.file, obj.not_kept);
  return std::move(obj.file);
}

std::string write_obj(Eigen::Ref<const Mat3X> points, const std::vector<Triangle>& triangles) {
  std::string text;
  text.reserve(static_cast<size_t>(points.cols()) * 60 + triangles.size() * 24);
  for (Eigen::Index v = 0; v < points.cols(); ++v) {
    text += "v ";
    append_three(text, points.col(v));
    text += '\n';
  }
  for (const auto& [a, b, c] : triangles) {
    text += "f ";
    append_three(text, std::array{a + 1, b + 1, c + 1});
    text += '\n';
  }
  return text;
}

}  // namespace hooke
