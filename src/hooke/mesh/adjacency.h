// Adjacency of a triangle mesh in plain arrays: twins of half-edges, the check that the faces around each
// vertex form one fan (an oriented manifold), and incidences of vertices, edges and faces.
#pragma once

#include "hooke/core/lists.h"
#include "hooke/core/types.h"

namespace hooke {

/// How the faces around a vertex are connected.
enum class Fan : char {
  isolated,  // no faces
  whole,     // faces in one chain or cycle, consistently oriented
  broken,    // anything else: non-manifold, not consistently oriented, or a duplicate face
};

struct HalfEdges {
  IntLists faces;  // of each vertex, ascending
  /// The twin of each half-edge, -1 on the boundary. Half-edge 3 f + k runs from corner k of face f to the
  /// next corner; its twin runs back. Meaningless at a broken fan.
  std::vector<int> twins;
};

struct VertexFans : HalfEdges {
  std::vector<Fan> kinds;  // per vertex
};

/// Twins of half-edges, without and with a check of the fans.
/// Pre-condition: corners in [0, vertex_count), three different ones per face.
HalfEdges pair_half_edges(int vertex_count, const std::vector<Triangle>& faces);
VertexFans examine_fans(int vertex_count, const std::vector<Triangle>& faces);

/// The first vertex whose fan is broken; -1 for a manifold.
int first_broken(const VertexFans& fans);

/// Incidences in flat arrays. Faces and vertices have the ids of the triangles that it was made from; edges
/// are numbered in the order in which the faces first name them.
struct Adjacency {
  int vertex_count = 0;
  std::vector<Triangle> faces;
  std::vector<Edge> edges;                     // directed as in their first face
  std::vector<std::array<int, 2>> edge_faces;  // second is -1 on the boundary
  std::vector<Triangle> face_edges;            // edge k joins corners k and k + 1
  IntLists vertex_faces;                       // ascending
  IntLists vertex_edges;                       // ascending
  IntLists vertex_neighbours;                  // in the order of vertex_edges

  // Creases divide the faces around a vertex into wedges, see mesh/wedges.h. Wedges [0, vertex_count) are the
  // first ones of the vertices, extra wedges follow. All empty without creases; set by split_wedges().
  std::vector<char> creases;          // per edge
  std::vector<Triangle> wedge_faces;  // wedges of the corners
  std::vector<Edge> wedge_edges;      // wedges of the ends in the edge's first face
  std::vector<int> extra_wedges;      // vertex of each extra wedge, ascending

  bool is_boundary_edge(int edge) const { return edge_faces[edge][1] < 0; }
  bool is_crease(int edge) const { return !creases.empty() && creases[edge] != 0; }
  bool is_feature_edge(int edge) const { return is_boundary_edge(edge) || is_crease(edge); }
  int other_end(int edge, int vertex) const {
    const auto& [a, b] = edges[edge];
    return a == vertex ? b : a;
  }
  int wedge_count() const { return vertex_count + static_cast<int>(extra_wedges.size()); }
  int vertex_of_wedge(int wedge) const {
    return wedge < vertex_count ? wedge : extra_wedges[wedge - vertex_count];
  }

  /// Indices of normals: the wedges of corners and of edge ends, which are the vertices without creases.
  const std::vector<Triangle>& wedges_of_faces() const { return creases.empty() ? faces : wedge_faces; }
  const std::vector<Edge>& wedges_of_edges() const { return creases.empty() ? edges : wedge_edges; }
};

/// Pre-condition: manifold, consistently oriented triangles on vertices [0, vertex_count).
Adjacency make_adjacency(int vertex_count, std::vector<Triangle> faces);

/// The same with half-edges that are already paired.
Adjacency make_adjacency(std::vector<Triangle> faces, HalfEdges half_edges);

/// The given vertices and those within this number of rings around them.
std::vector<int> with_rings(const Adjacency& adjacency, const std::vector<int>& vertices, int rings);

}  // namespace hooke
