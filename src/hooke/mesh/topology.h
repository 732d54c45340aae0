// Topology and valences of a mesh, independent of the positions of its vertices.
#pragma once

#include <vector>

#include "hooke/mesh/adjacency.h"

namespace hooke {

struct Topology {
  int vertices = 0;
  int edges = 0;
  int faces = 0;
  int isolated_vertices = 0;  // without a face; not counted in `components` and `euler`
  int components = 0;
  int boundary_edges = 0;
  int boundary_loops = 0;
  int euler = 0;           // vertices - edges + faces
  int junction_edges = 0;  // of a joined mesh, see junctions.h

  bool closed() const { return faces > 0 && boundary_edges == 0; }
};

/// Histograms: entry k is the number of vertices with k edges. Isolated vertices are not counted.
struct Valence {
  std::vector<int> interior;
  std::vector<int> boundary;
};

Topology measure_topology(const Adjacency& adjacency);
Valence count_valences(const Adjacency& adjacency);

/// Whether each vertex lies on a boundary edge.
std::vector<char> boundary_vertices(const Adjacency& adjacency);

}  // namespace hooke
