// Flat connectivity: who touches whom, in plain arrays for the hot loops.
#pragma once

#include <span>

#include "hooke/types.h"

namespace hooke {

/// Lists of ints, one per index, stored end to end.
struct IntLists {
  std::vector<int> first;  // size n + 1
  std::vector<int> items;

  std::span<const int> operator[](int i) const {
    return {items.data() + first[static_cast<size_t>(i)], items.data() + first[static_cast<size_t>(i) + 1]};
  }
};

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

  // Creases part the faces about a vertex; each part sees a side of its own of it. Sides [0, vertex_count)
  // are the first ones of the vertices. All empty without creases; set by part_at_creases().
  std::vector<char> creases;         // per edge
  std::vector<Triangle> side_faces;  // the corners' sides
  std::vector<Edge> side_edges;      // the ends' sides, as the edge's first face sees them
  std::vector<int> further_sides;    // the vertex of each further side, ascending

  bool is_boundary_edge(int edge) const { return edge_faces[static_cast<size_t>(edge)][1] < 0; }
  bool is_crease(int edge) const { return !creases.empty() && creases[static_cast<size_t>(edge)] != 0; }
  bool is_border(int edge) const { return is_boundary_edge(edge) || is_crease(edge); }
  int side_count() const { return vertex_count + static_cast<int>(further_sides.size()); }

  /// What normals are looked up by: the sides of corners and of ends, which are the vertices without creases.
  const std::vector<Triangle>& sides_of_faces() const { return creases.empty() ? faces : side_faces; }
  const std::vector<Edge>& sides_of_edges() const { return creases.empty() ? edges : side_edges; }
};

/// Pre-condition: manifold, consistently oriented triangles on vertices [0, vertex_count).
Connectivity make_connectivity(int vertex_count, std::vector<Triangle> faces);

}  // namespace hooke
