// A half-edge mesh of triangles in flat arrays, whose edges can be flipped, split and collapsed. Faces and
// vertices keep their ids: a flip reuses the ids of its two faces, a split adds ids at the end, and the ids
// freed by a collapse stay unused until compact(). Vertices and their extra wedges on creases share one range
// of ids.
#pragma once

#include "hooke/core/lists.h"
#include "hooke/mesh/adjacency.h"

namespace hooke {

/// Crease edges of the adjacency are constrained: no flip may lose them. Half-edge 3 f + k runs from corner k
/// of face f to corner k + 1; its twin runs back in the face across.
class HalfedgeMesh {
 public:
  explicit HalfedgeMesh(const Adjacency& adjacency);

  /// Tells which vertices are at junctions (see junctions.h): per vertex the number of its place, which
  /// copies share, or -1. A new edge may join two places only if a single sheet has both, with one copy of
  /// each: then no other edge ever joins them, and no two sheets can come to lie on each other.
  void mark_junctions(const std::vector<int>& places);
  /// The same of a vertex that a split has put on an edge between two of them.
  void mark_junction(int vertex, int place);
  bool at_junction(int vertex) const {
    const std::size_t v = vertex;
    return v < place_.size() && place_[v] >= 0;
  }

  const std::vector<Triangle>& faces() const { return faces_; }
  const std::vector<int>& twins() const { return twins_; }             // per half-edge, see twin()
  int id_count() const { return static_cast<int>(valences_.size()); }  // including removed vertices
  /// Wedges of the corners of each face.
  const std::vector<Triangle>& wedges() const { return wedges_.empty() ? faces_ : wedges_; }
  int half_edge_count() const { return static_cast<int>(twins_.size()); }

  int from(int h) const { return faces_[h / 3][h % 3]; }
  int to(int h) const { return from(next(h)); }
  int opposite_vertex(int h) const { return from(previous(h)); }  // in the face of h
  int twin(int h) const { return twins_[h]; }                     // -1 on the boundary
  /// The wedge of from(h) in the face of h.
  int wedge(int h) const { return wedges()[h / 3][h % 3]; }
  static int next(int h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static int previous(int h) { return h % 3 == 0 ? h + 2 : h - 1; }

  /// Number of edges at the vertex.
  int valence(int vertex) const { return valences_[vertex]; }

  /// Whether a collapse has removed the face; its half-edges then have neither vertices nor twins.
  bool is_removed(int face) const { return faces_[face][0] < 0; }

  bool on_boundary(int vertex) const { return on_boundary_[vertex] != 0; }

  /// The outgoing half-edges of the vertex, counter-clockwise, on the boundary beginning with the boundary
  /// half-edge.
  SmallIntList outgoing(int vertex) const;

  /// The neighbours of the vertex, counter-clockwise.
  SmallIntList neighbours(int vertex) const;
  /// The outgoing half-edges in the wedge of h, counter-clockwise between two feature edges; it includes the
  /// first of these two.
  SmallIntList wedge_halfedges(int h) const;

  /// Whether a crease runs through the vertex or ends there.
  bool on_crease(int vertex) const;

  /// Whether an edge joins a and b.
  bool adjacent(int a, int b) const;

  /// The half-edge from one vertex to the other, -1 if there is none.
  int half_edge(int from, int to) const;
  /// Whether a new edge may join a and b: no edge does, and their places at junctions allow it.
  bool may_connect(int a, int b) const { return !adjacent(a, b) && may_join_places(a, b); }

  /// Whether the edge of h is a crease edge.
  bool is_crease(int h) const { return constrained_[h] != 0; }
  /// Whether the edge of h is a crease edge or a boundary edge.
  bool is_feature_edge(int h) const { return twin(h) < 0 || is_crease(h); }

  /// Replaces the edge of h by the one between its two opposite vertices.
  /// Pre-condition: h has a twin, is not constrained, and no edge joins the opposite vertices.
  void flip(int h);

  /// The half-edge of the flipped edge in the face of h, after flip(h).
  static int flipped(int h) { return h / 3 * 3 + 2; }

  /// Splits the edge of h, and the faces there in two, at a new vertex and returns its id, the first new one.
  /// h then ends at the new vertex. Both halves are constrained if the edge was; the next id is then the
  /// wedge of the new vertex on the right of h.
  int split(int h);

  /// Whether the edge of h can be collapsed without a change of the topology, including that of the creases.
  /// The link condition: H. Edelsbrunner, "Geometry and topology for mesh generation", 2001. Holes,
  /// components and the pieces between creases keep at least one triangle.
  bool keeps_topology(int h) const;

  /// The same, where the collapse neither merges two places at junctions, nor joins two that may not be
  /// joined, nor makes a face that another sheet may have too.
  bool may_collapse(int h) const { return keeps_topology(h) && keeps_places(h); }

  /// The wedge of `stays`, an end of h, that the outgoing half-edge `out` of either end belongs to after
  /// the collapse of h. Pre-condition: the other end has no wedges but those along h.
  int wedge_after_collapse(int h, int stays, int out) const;

  /// Collapses the edge of h: its other end is merged into `stays`, and the faces of h are removed. Edges
  /// that coincide afterwards are constrained if one of them was. Pre-condition: keeps_topology(h).
  void collapse(int h, int stays);

  /// Removes the unused ids of vertices and faces and puts the others in memory order, see
  /// bfs_cluster_order(). Returns the old ids of the vertices in the new order. Wedges keep their ids: if
  /// there are creases, set_wedges() must follow.
  std::vector<int> compact();

  /// Takes over the numbering of the wedges of an adjacency with the same faces.
  void set_wedges(const Adjacency& adjacency);

 private:
  int first_outgoing(int vertex) const;
  void link(int h, int twin);
  void split(int h, int vertex, int wedge);
  void close(int h);
  bool may_join_places(int a, int b) const;
  bool keeps_places(int h) const;

  std::vector<Triangle> faces_;
  std::vector<Triangle> wedges_;  // empty without creases: the wedges are then the vertices
  std::vector<int> twins_;
  std::vector<int> outgoing_halfedge_;  // per id: one outgoing half-edge, -1 without faces
  std::vector<int> valences_;           // per id: -1 for removed vertices and extra wedges
  std::vector<char> on_boundary_;       // per id
  std::vector<char> constrained_;       // per half-edge
  // Of vertices at junctions; -1, or nothing beyond the end, for others.
  std::vector<int> place_;                   // per id
  std::vector<int> sheet_;                   // per id: a number of its sheet
  std::vector<std::vector<int>> sheets_at_;  // by place: the sheet of each copy
};

/// The adjacency of a half-edge mesh, without creases; faster than from the faces alone. Pre-condition: no
/// face is removed, and the mesh has `vertex_count` vertices.
Adjacency adjacency_of(const HalfedgeMesh& halfedges, int vertex_count);

}  // namespace hooke
