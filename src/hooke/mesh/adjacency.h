// The faces around each vertex as one fan: what makes a triangle mesh a manifold with an orientation.
#pragma once

#include "hooke/core/lists.h"
#include "hooke/core/types.h"

namespace hooke {

enum class Fan : char {
  isolated,  // no faces
  whole,     // faces in one chain or cycle, oriented alike
  broken,    // anything else: not a manifold there, or not oriented, or a face twice
};

struct HalfEdges {
  IntLists faces;  // of each vertex, ascending
  /// The half-edge across each half-edge. Half-edge 3 f + k runs from corner k of face f to the next corner;
  /// its twin runs back, or is -1 on the boundary. Says nothing at a broken ring.
  std::vector<int> twins;
};

struct VertexFans : HalfEdges {
  std::vector<Fan> kinds;  // per vertex
};

/// Pre-condition of both: corners in [0, vertex_count), three different ones to a face.
HalfEdges pair_half_edges(int vertex_count, const std::vector<Triangle>& faces);
VertexFans examine_fans(int vertex_count, const std::vector<Triangle>& faces);

/// The first vertex whose ring is broken; -1 for a manifold.
int first_broken(const VertexFans& fans);

// Flat connectivity: who touches whom, in plain arrays for the hot loops.

/// Invariant: faces, edges and vertices have the ids of the triangles it was made from; edges are numbered in
/// the order in which the faces first name them.
struct Adjacency {
  int vertex_count = 0;
  std::vector<Triangle> faces;
  std::vector<Edge> edges;                     // as the first face runs through it
  std::vector<std::array<int, 2>> edge_faces;  // second is -1 on the boundary
  std::vector<Triangle> face_edges;            // edge k joins corners k and k + 1
  IntLists vertex_faces;                       // ascending
  IntLists vertex_edges;                       // ascending
  IntLists vertex_neighbours;                  // in the order of vertex_edges

  // Creases part the faces about a vertex; each part sees a side of its own of it. Sides [0, vertex_count)
  // are the first ones of the vertices. All empty without creases; set by split_wedges().
  std::vector<char> creases;         // per edge
  std::vector<Triangle> side_faces;  // the corners' sides
  std::vector<Edge> side_edges;      // the ends' sides, as the edge's first face sees them
  std::vector<int> extra_wedges;     // the vertex of each further side, ascending

  bool is_boundary_edge(int edge) const { return edge_faces[static_cast<size_t>(edge)][1] < 0; }
  bool is_crease(int edge) const { return !creases.empty() && creases[static_cast<size_t>(edge)] != 0; }
  bool is_feature_edge(int edge) const { return is_boundary_edge(edge) || is_crease(edge); }
  int other_end(int edge, int vertex) const {
    const auto& [a, b] = edges[static_cast<size_t>(edge)];
    return a == vertex ? b : a;
  }
  int wedge_count() const { return vertex_count + static_cast<int>(extra_wedges.size()); }
  int vertex_of_wedge(int wedge) const {
    return wedge < vertex_count ? wedge : extra_wedges[static_cast<size_t>(wedge - vertex_count)];
  }

  /// What normals are looked up by: the sides of corners and of ends, which are the vertices without creases.
  const std::vector<Triangle>& wedges_of_faces() const { return creases.empty() ? faces : side_faces; }
  const std::vector<Edge>& wedges_of_edges() const { return creases.empty() ? edges : side_edges; }
};

/// Pre-condition: manifold, consistently oriented triangles on vertices [0, vertex_count).
Adjacency make_adjacency(int vertex_count, std::vector<Triangle> faces);

/// The same where their half-edges have been paired before.
Adjacency make_adjacency(std::vector<Triangle> faces, HalfEdges half_edges);

/// These vertices and those within so many rings about them.
std::vector<int> with_rings(const Adjacency& adjacency, const std::vector<int>& vertices, int rings);

}  // namespace hooke
