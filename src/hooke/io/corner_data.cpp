#include "hooke/io/corner_data.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace hooke {
namespace {

bool same_values(const CornerData& data, int a, int b) {
  return a == b || data.values.col(a) == data.values.col(b);
}

// An edge of a polygon, and the elements that the corners at its ends have there.
struct Side {
  Edge ends;  // ascending
  std::array<int, 2> elements;
};

std::vector<Side> sides_at(const std::vector<char>& chosen, const CornerData& data,
                           const IntLists& polygons) {
  std::vector<Side> sides;
  for (size_t f = 0; f + 1 < polygons.first.size(); ++f) {
    const int begin = polygons.first[f], end = polygons.first[f + 1];
    for (int c = begin; c < end; ++c) {
      size_t from = static_cast<size_t>(c), to = static_cast<size_t>(c + 1 < end ? c + 1 : begin);
      if (polygons.items[from] > polygons.items[to]) std::swap(from, to);
      const Edge ends{polygons.items[from], polygons.items[to]};
      if (chosen[static_cast<size_t>(ends[0])] || chosen[static_cast<size_t>(ends[1])])
        sides.push_back({ends, {data.elements[from], data.elements[to]}});
    }
  }
  return sides;
}

size_t count_edges_that_differ(std::vector<Side> sides, const CornerData& data) {
  std::ranges::stable_sort(sides, {}, &Side::ends);
  size_t count = 0;
  for (auto first = sides.begin(); first != sides.end();) {
    const auto next = std::find_if(first, sides.end(), [&](const Side& s) { return s.ends != first->ends; });
    count += std::any_of(first, next, [&](const Side& s) {
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

Warning warning_of(const Seams& seams, const std::string& name, const CornerDataKind& kind) {
  constexpr size_t most = 10;
  std::vector<int> numbers;  // as the file counts them
  for (size_t k = 0; k < std::min(most, seams.vertices.size()); ++k) numbers.push_back(seams.vertices[k] + 1);
  return {
      kind.code,
      fmt::format("{}: not kept in the output: {}, because of {} (edges: {}; vertices with several {}: {}, "
                  "numbers {}{}); to keep them cut the mesh open there, so that each vertex has one {}",
                  name, kind.what, kind.seams, seams.edges, kind.element, seams.vertices.size(),
                  fmt::join(numbers, " "), seams.vertices.size() > most ? " ..." : "", kind.element)};
}

}  // namespace

std::vector<int> elements_of_vertices(const CornerData& data, const IntLists& polygons, int vertex_count) {
  std::vector<int> of_vertices(static_cast<size_t>(vertex_count), -1);
  for (size_t c = 0; c < polygons.items.size(); ++c) {
    int& element = of_vertices[static_cast<size_t>(polygons.items[c])];
    if (element < 0) element = data.elements[c];
  }
  return of_vertices;
}

Seams find_seams(const CornerData& data, const IntLists& polygons, const std::vector<int>& of_vertices) {
  std::vector<char> on_seam(of_vertices.size(), 0);
  for (size_t c = 0; c < polygons.items.size(); ++c) {
    const size_t v = static_cast<size_t>(polygons.items[c]);
    on_seam[v] |= static_cast<char>(!same_values(data, data.elements[c], of_vertices[v]));
  }
  Seams seams;
  for (size_t v = 0; v < on_seam.size(); ++v)
    if (on_seam[v]) seams.vertices.push_back(static_cast<int>(v));
  if (!seams.vertices.empty()) seams.edges = count_edges_that_differ(sides_at(on_seam, data, polygons), data);
  return seams;
}

void keep_as_vertex_data(MeshFile& file, const CornerData& data, size_t width, const CornerDataKind& kind) {
  const std::vector<int> of_vertices =
      elements_of_vertices(data, file.polygons, static_cast<int>(file.points.cols()));
  const Seams seams = find_seams(data, file.polygons, of_vertices);
  if (seams.vertices.empty())
    append_channels(file.vertex_data, data.values, of_vertices, kind.channels.first(width), kind.type);
  else
    file.warnings.push_back(warning_of(seams, file.name, kind));
}

}  // namespace hooke
