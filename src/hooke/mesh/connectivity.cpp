#include "hooke/mesh/connectivity.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "hooke/core/parallel.h"

namespace hooke {
namespace {

constexpr size_t block = 1024;

/// Whether the face of half-edge h is the first that names its edge.
bool names_edge(const std::vector<int>& twins, size_t h) {
  return twins[h] < 0 || static_cast<int>(h) < twins[h];
}

/// Numbers the edges in the order of the half-edges that name them.
void number_edges(const std::vector<int>& twins, Connectivity& c) {
  std::vector<int> first(twins.size() / block + 2, 0);  // edge of each block of half-edges
  parallel_for(twins.size(), block, [&](size_t begin, size_t end) {
    for (size_t h = begin; h < end; ++h) first[h / block + 1] += names_edge(twins, h);
  });
  std::partial_sum(first.begin(), first.end(), first.begin());
  c.edges.resize(static_cast<size_t>(first.back()));
  c.edge_faces.resize(c.edges.size());
  c.face_edges.resize(c.faces.size());
  parallel_for(twins.size(), block, [&](size_t begin, size_t end) {
    int edge = first[begin / block];
    for (size_t h = begin; h < end; ++h) {
      if (!names_edge(twins, h)) continue;
      const Triangle& t = c.faces[h / 3];
      c.edges[static_cast<size_t>(edge)] = {t[h % 3], t[(h + 1) % 3]};
      c.edge_faces[static_cast<size_t>(edge)] = {static_cast<int>(h / 3), twins[h] < 0 ? -1 : twins[h] / 3};
      c.face_edges[h / 3][h % 3] = edge;
      if (twins[h] >= 0)
        c.face_edges[static_cast<size_t>(twins[h]) / 3][static_cast<size_t>(twins[h]) % 3] = edge;
      ++edge;
    }
  });
}

/// The other end of every edge in c.vertex_edges.
IntLists other_ends(const Connectivity& c) {
  IntLists lists = c.vertex_edges;
  parallel_for(static_cast<size_t>(c.vertex_count), block, [&](size_t begin, size_t end) {
    for (size_t v = begin; v < end; ++v)
      for (auto i = static_cast<size_t>(lists.first[v]); i < static_cast<size_t>(lists.first[v + 1]); ++i)
        lists.items[i] = c.other_end(lists.items[i], static_cast<int>(v));
  });
  return lists;
}

}  // namespace

Connectivity make_connectivity(int vertex_count, std::vector<Triangle> faces) {
  HalfEdges half_edges = pair_half_edges(vertex_count, faces);
  return make_connectivity(std::move(faces), std::move(half_edges));
}

Connectivity make_connectivity(std::vector<Triangle> faces, HalfEdges half_edges) {
  Connectivity c;
  c.vertex_count = static_cast<int>(half_edges.faces.first.size()) - 1;
  c.faces = std::move(faces);
  c.vertex_faces = std::move(half_edges.faces);
  number_edges(half_edges.twins, c);
  c.vertex_edges = invert(c.vertex_count, c.edges);
  c.vertex_neighbours = other_ends(c);
  return c;
}

std::vector<int> with_rings(const Connectivity& c, const std::vector<int>& vertices, int rings) {
  std::vector<char> marked(static_cast<size_t>(c.vertex_count), 0);
  std::vector<int> all;
  const auto add = [&](int v) {
    if (!std::exchange(marked[static_cast<size_t>(v)], 1)) all.push_back(v);
  };
  std::ranges::for_each(vertices, add);
  for (int ring = 0; ring < rings; ++ring)
    for (size_t i = 0, count = all.size(); i < count; ++i)
      std::ranges::for_each(c.vertex_neighbours[all[i]], add);
  return all;
}

}  // namespace hooke
