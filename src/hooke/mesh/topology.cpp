#include "hooke/mesh/topology.h"

#include <numeric>

namespace hooke {
namespace {

/// Disjoint sets of the ids [0, n), joined by edges.
class DisjointSets {
 public:
  explicit DisjointSets(int n) : parent_(static_cast<size_t>(n)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  int root(int i) {
    while (parent_[static_cast<size_t>(i)] != i) {
      int& parent = parent_[static_cast<size_t>(i)];
      parent = parent_[static_cast<size_t>(parent)];
      i = parent;
    }
    return i;
  }
  void join(const Edge& e) { parent_[static_cast<size_t>(root(e[0]))] = root(e[1]); }

 private:
  std::vector<int> parent_;
};

}  // namespace

std::vector<char> boundary_vertices(const Connectivity& connectivity) {
  std::vector<char> on_boundary(static_cast<size_t>(connectivity.vertex_count), 0);
  for (size_t e = 0; e < connectivity.edges.size(); ++e)
    if (connectivity.is_boundary_edge(static_cast<int>(e)))
      for (int v : connectivity.edges[e]) on_boundary[static_cast<size_t>(v)] = 1;
  return on_boundary;
}

Topology measure_topology(const Connectivity& connectivity) {
  Topology t;
  t.vertices = connectivity.vertex_count;
  t.edges = static_cast<int>(connectivity.edges.size());
  t.faces = static_cast<int>(connectivity.faces.size());

  DisjointSets parts(t.vertices);
  DisjointSets rims(t.vertices);
  for (size_t e = 0; e < connectivity.edges.size(); ++e) {
    parts.join(connectivity.edges[e]);
    if (!connectivity.is_boundary_edge(static_cast<int>(e))) continue;
    rims.join(connectivity.edges[e]);
    ++t.boundary_edges;
  }
  const std::vector<char> on_boundary = boundary_vertices(connectivity);
  for (int v = 0; v < t.vertices; ++v) {
    if (connectivity.vertex_faces[v].empty()) {
      ++t.isolated_vertices;
      continue;
    }
    t.components += parts.root(v) == v;
    t.boundary_loops += on_boundary[static_cast<size_t>(v)] && rims.root(v) == v;
  }
  t.euler = t.vertices - t.isolated_vertices - t.edges + t.faces;
  return t;
}

Valence count_valences(const Connectivity& connectivity) {
  Valence valence;
  const std::vector<char> on_boundary = boundary_vertices(connectivity);
  for (int v = 0; v < connectivity.vertex_count; ++v) {
    const size_t edges = connectivity.vertex_edges[v].size();
    if (edges == 0) continue;
    std::vector<int>& counts = on_boundary[static_cast<size_t>(v)] ? valence.boundary : valence.interior;
    if (counts.size() <= edges) counts.resize(edges + 1, 0);
    ++counts[edges];
  }
  return valence;
}

}  // namespace hooke
