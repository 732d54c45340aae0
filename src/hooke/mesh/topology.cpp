#include "hooke/mesh/topology.h"

#include "hooke/mesh/disjoint_sets.h"

namespace hooke {

std::vector<char> boundary_vertices(const Adjacency& adjacency) {
  std::vector<char> on_boundary(adjacency.vertex_count, 0);
  for (size_t e = 0; e < adjacency.edges.size(); ++e)
    if (adjacency.is_boundary_edge(static_cast<int>(e)))
      for (int v : adjacency.edges[e]) on_boundary[v] = 1;
  return on_boundary;
}

Topology measure_topology(const Adjacency& adjacency) {
  Topology t;
  t.vertices = adjacency.vertex_count;
  t.edges = static_cast<int>(adjacency.edges.size());
  t.faces = static_cast<int>(adjacency.faces.size());

  DisjointSets components(adjacency.vertex_count);
  DisjointSets boundary_loops(adjacency.vertex_count);
  for (size_t e = 0; e < adjacency.edges.size(); ++e) {
    components.join(adjacency.edges[e]);
    if (!adjacency.is_boundary_edge(static_cast<int>(e))) continue;
    boundary_loops.join(adjacency.edges[e]);
    ++t.boundary_edges;
  }
  const std::vector<char> on_boundary = boundary_vertices(adjacency);
  for (int v = 0; v < t.vertices; ++v) {
    if (adjacency.vertex_faces[v].empty()) {
      ++t.isolated_vertices;
      continue;
    }
    t.components += components.root(v) == v;
    t.boundary_loops += on_boundary[v] && boundary_loops.root(v) == v;
  }
  t.euler = t.vertices - t.isolated_vertices - t.edges + t.faces;
  return t;
}

Valence count_valences(const Adjacency& adjacency) {
  Valence valence;
  const std::vector<char> on_boundary = boundary_vertices(adjacency);
  for (int v = 0; v < adjacency.vertex_count; ++v) {
    const size_t edges = adjacency.vertex_edges[v].size();
    if (edges == 0) continue;
    std::vector<int>& counts = on_boundary[v] ? valence.boundary : valence.interior;
    if (counts.size() <= edges) counts.resize(edges + 1, 0);
    ++counts[edges];
  }
  return valence;
}

}  // namespace hooke
