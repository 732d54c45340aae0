// Flat connectivity: who touches whom, in plain arrays for the hot loops.
#pragma once

#include "hooke/vertex_fans.h"

namespace hooke {

/// Invariant: faces, edges and vertices have the ids of the triangles it was made from; edges are numbered in
/// the order in which the faces first name them.
struct Connectivity {
  int vertex_count = 0;
  std::vector<Triangle> faces;
  std::vector<Edge> edges;                     // as the first face runs through it
  std::vector<std::array<int, 2>> edge_faces;  // second is -1 on the boundary
  std::vector<Triangle> face_edges;            // edge k joins corners k and k + 1
  IntLists vertex_faces;                       // ascending
  IntLists vertex_edges;                       // ascending
  IntLists vertex_neighbours;                  // in the order of vertex_edges

  bool is_boundary_edge(int edge) const { return edge_faces[static_cast<size_t>(edge)][1] < 0; }
};

/// Pre-condition: manifold, consistently oriented triangles on vertices [0, vertex_count).
Connectivity make_connectivity(int vertex_count, std::vector<Triangle> faces);

/// The same where their fans have been examined before. Pre-condition: none is broken.
Connectivity make_connectivity(std::vector<Triangle> faces, VertexFans fans);

}  // namespace hooke
