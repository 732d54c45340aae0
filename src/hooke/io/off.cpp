#include "hooke/io/off.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "hooke/io/append_number.h"
#include "hooke/io/printable.h"
#include "hooke/io/scanner.h"

namespace hooke {
namespace {

struct OffHeader {
  bool texture = false, colours = false, normals = false;  // ST, C, N: numbers after the coordinates
  int vertices = 0, faces = 0;
};

// The letters before OFF, as far as we can read them.
std::optional<OffHeader> parse_keyword(const Scanner& in, std::string_view word) {
  if (word.size() < 3 || !equal_ignoring_case(word.substr(word.size() - 3), "OFF")) return std::nullopt;
  OffHeader header;
  std::string_view letters = word.substr(0, word.size() - 3);
  const auto take = [&](std::string_view prefix) {
    const bool there = equal_ignoring_case(letters.substr(0, prefix.size()), prefix);
    if (there) letters.remove_prefix(prefix.size());
    return there;
  };
  header.texture = take("ST");
  header.colours = take("C");
  // 'N' is normals, 'n' is the dimension: the only letter whose case matters.
  header.normals = !letters.empty() && letters[0] == 'N';
  if (header.normals) letters.remove_prefix(1);
  if (!letters.empty())
    in.fail(fmt::format(
        "keyword {}; expected OFF, COFF, NOFF, CNOFF or STOFF in three dimensions; save it as OFF",
        in_quotes(word)));
  return header;
}

int read_count(const Scanner& in, std::string_view token, std::string_view what) {
  const long long count = in.integer(token, what);
  if (count < 0 || count > std::numeric_limits<int>::max() ||
      static_cast<unsigned long long>(count) > in.remaining())
    in.fail(
        fmt::format("{} is {}, but only {} bytes follow; expected as many as there are; the file is cut or "
                    "the count is wrong",
                    what, count, in.remaining()));
  return static_cast<int>(count);
}

OffHeader read_header(Scanner& in) {
  if (!in.next_line()) in.fail("no content; expected OFF; the file is empty");
  std::string_view word = in.token();
  const std::optional<OffHeader> keyword = parse_keyword(in, word);
  OffHeader header = keyword.value_or(OffHeader{});
  if (keyword) {
    word = in.token();
    if (equal_ignoring_case(word, "BINARY")) in.fail("binary OFF; expected a text file; save it as text");
    if (word.empty() && !in.next_line())
      in.fail("the file ends after its keyword; expected the counts; it is cut");
    if (word.empty()) word = in.token();
  }
  const std::string_view faces = in.token(), edges = in.token();
  header.vertices = read_count(in, word, "vertex count");
  header.faces = read_count(in, faces, "face count");
  if (!edges.empty()) in.integer(edges, "edge count");
  if (const std::string_view more = in.token(); !more.empty())
    in.fail(fmt::format("{} after the counts; expected vertex, face and edge count only; correct it",
                        in_quotes(more)));
  return header;
}

void next_row(Scanner& in, const char* kind, int row, int count) {
  if (!in.next_line())
    in.fail(fmt::format(
        "the file ends before {} {} of {} (counted from 0); the file is cut or the count is wrong", kind, row,
        count));
}

// Returns how many numbers follow the coordinates, on every vertex line alike.
int read_vertices(Scanner& in, const OffHeader& header, Mat3X& points) {
  std::vector<double> coordinates;
  coordinates.reserve(std::min<size_t>(3 * static_cast<size_t>(header.vertices), in.remaining()));
  int extra = -1;
  for (int v = 0; v < header.vertices; ++v) {
    next_row(in, "vertex", v, header.vertices);
    for (const char* what : {"x", "y", "z"}) coordinates.push_back(in.number(what));
    int more = 0;
    for (std::string_view token = in.token(); !token.empty(); token = in.token(), ++more)
      in.number(token, "vertex value");
    if (extra < 0) extra = more;
    if (more != extra)
      in.fail(fmt::format(
          "vertex {} with {} numbers; expected {} as on the first vertex line; is the vertex count right?", v,
          3 + more, 3 + extra));
  }
  points = Eigen::Map<const Mat3X>(coordinates.data(), 3, header.vertices);
  return std::max(extra, 0);
}

// Returns whether the line ends in a colour.
bool read_face(Scanner& in, int face, int vertex_count, MeshFile& file) {
  const long long corners = in.integer("face size");
  if (corners < 3)
    in.fail(fmt::format("face {} with {} corners; expected 3 or more; correct or remove it", face, corners));
  for (long long k = 0; k < corners; ++k) {
    const long long id = in.integer("face corner");
    if (id < 0 || id >= vertex_count)
      in.fail(fmt::format("face {} has vertex index {}; expected 0 to {}; correct the index", face, id,
                          vertex_count - 1));
    file.polygons.items.push_back(static_cast<int>(id));
  }
  int extra = 0;
  for (std::string_view token = in.token(); !token.empty(); token = in.token(), ++extra)
    in.number(token, "face colour");
  if (extra == 2 || extra > 4)
    in.fail(fmt::format(
        "{} numbers after face {}; expected a colour of 1, 3 or 4, or none; is the face size right?", extra,
        face));
  file.lines.push_back(in.line());
  end_polygon(file);
  return extra > 0;
}

std::vector<std::string> kinds_not_kept(const OffHeader& header, int vertex_extra, bool face_colours) {
  std::vector<std::string> kinds;
  if (header.normals) kinds.emplace_back("normals");
  if (header.colours) kinds.emplace_back("vertex colours");
  if (header.texture) kinds.emplace_back("texture coordinates");
  if (kinds.empty() && vertex_extra > 0)
    kinds.push_back(fmt::format("{} more numbers on each vertex line", vertex_extra));
  if (face_colours) kinds.emplace_back("face colours");
  return kinds;
}

}  // namespace

MeshFile read_off(std::string_view text, const std::string& name) {
  Scanner in(text, name, {.comments = true});
  const OffHeader header = read_header(in);
  MeshFile file;
  file.name = name;
  file.format = "off";
  const int vertex_extra = read_vertices(in, header, file.points);
  const int wanted = (header.normals ? 3 : 0) + (header.colours ? 1 : 0) + (header.texture ? 2 : 0);
  if (header.vertices > 0 && vertex_extra < wanted)
    in.fail(fmt::format("vertices have {} numbers; expected at least {} by the keyword; correct the keyword",
                        3 + vertex_extra, 3 + wanted));
  bool face_colours = false;
  for (int f = 0; f < header.faces; ++f) {
    next_row(in, "face", f, header.faces);
    face_colours |= read_face(in, f, header.vertices, file);
  }
  if (in.next_line())
    in.fail(
        fmt::format("text after the last of {} faces; expected the end of the file; is the face count right?",
                    header.faces));
  warn_not_kept(file, kinds_not_kept(header, vertex_extra, face_colours));
  return file;
}

std::string write_off(Eigen::Ref<const Mat3X> points, const std::vector<Triangle>& triangles) {
  std::string text = fmt::format("OFF\n{} {} 0\n", points.cols(), triangles.size());
  text.reserve(static_cast<size_t>(points.cols()) * 60 + triangles.size() * 24);
  for (Eigen::Index v = 0; v < points.cols(); ++v) {
    append_three(text, points.col(v));
    text += '\n';
  }
  for (const Triangle& triangle : triangles) {
    text += "3 ";
    append_three(text, triangle);
    text += '\n';
  }
  return text;
}

}  // namespace hooke
