#include "hooke/io/obj_corner_data.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "hooke/core/error.h"
#include "hooke/core/printable.h"

namespace hooke {
namespace {

bool same_values(const ElementsOfCorners& data, int a, int b) {
  return a == b || data.values.col(a) == data.values.col(b);
}

// An edge of a polygon and the elements of the two corners at its ends.
struct PolygonEdge {
  Edge ends;  // vertex ids, ascending
  std::array<int, 2> elements;
};

std::vector<PolygonEdge> edges_at(const std::vector<char>& chosen, const ElementsOfCorners& data,
                                  const IntLists& polygons) {
  std::vector<PolygonEdge> edges;
  for (size_t f = 0; f + 1 < polygons.first.size(); ++f) {
    const int begin = polygons.first[f], end = polygons.first[f + 1];
    for (int c = begin; c < end; ++c) {
      size_t from = c, to = c + 1 < end ? c + 1 : begin;
      if (polygons.items[from] > polygons.items[to]) std::swap(from, to);
      const Edge ends{polygons.items[from], polygons.items[to]};
      if (chosen[ends[0]] || chosen[ends[1]])
        edges.push_back({ends, {data.elements[from], data.elements[to]}});
    }
  }
  return edges;
}

size_t count_edges_that_differ(std::vector<PolygonEdge> edges, const ElementsOfCorners& data) {
  std::ranges::stable_sort(edges, {}, &PolygonEdge::ends);
  size_t count = 0;
  for (auto first = edges.begin(); first != edges.end();) {
    const auto next =
        std::find_if(first, edges.end(), [&](const PolygonEdge& s) { return s.ends != first->ends; });
    count += std::any_of(first, next, [&](const PolygonEdge& s) {
      return !same_values(data, s.elements[0], first->elements[0]) ||
             !same_values(data, s.elements[1], first->elements[1]);
    });
    first = next;
  }
  return count;
}

void append_channels(VertexData& to, const Mat3X& values, const std::vector<int>& of_vertices,
                     ChannelNames names, NumberType type) {
  for (size_t k = 0; k < names.size(); ++k) {
    std::vector<double>& channel = to.emplace_back(VertexChannel{names[k], type, {}}).values;
    channel.reserve(of_vertices.size());
    for (const int element : of_vertices)
      channel.push_back(element < 0 ? 0 : values(static_cast<Eigen::Index>(k), element));
  }
}

Warning warning_of(const CornerSeams& seams, const std::string& name, const CornerDataKind& kind) {
  constexpr size_t max_listed = 10;
  std::vector<int> numbers;  // 1-based, as in the file
  for (size_t k = 0; k < std::min(max_listed, seams.vertices.size()); ++k)
    numbers.push_back(seams.vertices[k] + 1);
  return {
      kind.code,
      fmt::format("{}: not kept in the output: {}, because of {} (edges: {}; vertices with several {}: {}, "
                  "numbers {}{}); to keep them write an OBJ, or cut the mesh open there, so that each "
                  "vertex has one {}",
                  name, kind.what, kind.seams, seams.edges, kind.element, seams.vertices.size(),
                  fmt::join(numbers, " "), seams.vertices.size() > max_listed ? " ..." : "", kind.element)};
}

}  // namespace

std::vector<int> elements_of_vertices(const ElementsOfCorners& data, const IntLists& polygons,
                                      int vertex_count) {
  std::vector<int> of_vertices(vertex_count, -1);
  for (size_t c = 0; c < polygons.items.size(); ++c) {
    int& element = of_vertices[polygons.items[c]];
    if (element < 0) element = data.elements[c];
  }
  return of_vertices;
}

CornerSeams find_corner_seams(const ElementsOfCorners& data, const IntLists& polygons,
                              const std::vector<int>& of_vertices) {
  std::vector<char> on_seam(of_vertices.size(), 0);
  for (size_t c = 0; c < polygons.items.size(); ++c) {
    const size_t v = polygons.items[c];
    on_seam[v] |= static_cast<char>(!same_values(data, data.elements[c], of_vertices[v]));
  }
  CornerSeams seams;
  for (size_t v = 0; v < on_seam.size(); ++v)
    if (on_seam[v]) seams.vertices.push_back(static_cast<int>(v));
  if (!seams.vertices.empty()) seams.edges = count_edges_that_differ(edges_at(on_seam, data, polygons), data);
  return seams;
}

Warnings keep_as_vertex_data(MeshFile& file, const ElementsOfCorners& data, size_t width,
                             const CornerDataKind& kind) {
  const std::vector<int> of_vertices =
      elements_of_vertices(data, file.polygons, static_cast<int>(file.points.cols()));
  const CornerSeams seams = find_corner_seams(data, file.polygons, of_vertices);
  if (!seams.vertices.empty()) return {warning_of(seams, file.name, kind)};
  append_channels(file.vertex_data, data.values, of_vertices, kind.channels.first(width), kind.type);
  return {};
}

void count_one(const Scanner& in, ObjElements& elements) {
  if (elements.count == std::numeric_limits<int>::max())
    in.fail("too many elements; expected at most 2147483647 of a kind; split the mesh");
  ++elements.count;
}

void read_numbers(Scanner& in, ObjElements& elements) {
  count_one(in, elements);
  auto column = elements.values.col(elements.count - 1);
  int numbers = 0;
  bool broken = false;
  for (std::string_view token = in.token(); !token.empty(); token = in.token(), ++numbers)
    broken |= numbers >= 3 || parse_number(token, column[numbers]) != NumberError::none;
  broken |= numbers < elements.min_numbers;
  if (broken && elements.broken_line == 0) elements.broken_line = in.line();
  elements.numbers = std::max(elements.numbers, numbers);
}

int read_index(const Scanner& in, std::string_view text, std::string_view corner, ObjElements& elements) {
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
  if (id > elements.max_index) {
    elements.max_index = id;
    elements.max_line = in.line();
  }
  return id;
}

void read_corner_index(const Scanner& in, std::string_view text, std::string_view corner, size_t number,
                       ObjElements& elements) {
  const int id = read_index(in, text, corner, elements);
  elements.of_corners.resize(number, -1);
  elements.of_corners.push_back(id);
}

void check_max_index(const std::string& name, const ObjElementPieces& pieces) {
  if (pieces.empty()) return;
  const ObjElements& asked =
      **std::ranges::max_element(pieces, {}, [](const ObjElements* elements) { return elements->max_index; });
  const int count = pieces.back()->count;
  if (asked.max_index >= count)
    throw InputError(
        fmt::format("{}:{}: {} index {}; expected at most {}, the number in the file; correct the index",
                    name, asked.max_line, asked.kind, asked.max_index + 1LL, count));
}

void keep_elements(const ObjElementPieces& pieces, const CornerDataKind& kind, MeshFile& file,
                   PolygonCorners& corners_of_file, std::vector<std::string>& not_kept) {
  const ObjElements& all = *pieces.front();
  if (all.values.cols() == 0) return;
  ElementsOfCorners data{all.values, {}};
  int numbers = 0, broken_line = 0;
  for (const ObjElements* piece : pieces) {
    data.elements.insert(data.elements.end(), piece->of_corners.begin(), piece->of_corners.end());
    numbers = std::max(numbers, piece->numbers);
    if (broken_line == 0) broken_line = piece->broken_line;
  }
  const auto without = std::ranges::count(data.elements, -1);
  const auto corners = std::ssize(data.elements);
  if (broken_line > 0) {
    not_kept.push_back(fmt::format("{} (line {}; expected {}3 finite numbers)", kind.what, broken_line,
                                   all.min_numbers < 3 ? "1 to " : ""));
    return;
  }
  if (without == corners) {
    not_kept.emplace_back(kind.what);
    return;
  }
  Warnings lost;
  if (without > 0)
    lost.push_back({"attributes_not_kept",
                    fmt::format("{}: not kept in the output: {} ({} of {} face corners have none)", file.name,
                                kind.what, without, corners)});
  else
    lost = keep_as_vertex_data(file, data, numbers, kind);
  if (lost.empty()) return;
  append(file.content.no_obj, lost);
  corners_of_file = {data.values, numbers, std::move(data.elements)};
}

}  // namespace hooke
