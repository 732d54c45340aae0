// Triangles whose edges can be flipped, split and collapsed: who lies across each edge, in flat arrays. Faces
// and vertices keep their ids; a flip reuses the ids of the two faces it joins, a split adds ids at the end,
// and those that a collapse sets free stay unused until compact(). Vertices and the further sides that they
// have on creases share one row of ids.
#pragma once

#include "hooke/core/lists.h"
#include "hooke/mesh/adjacency.h"

namespace hooke {

/// Creases of the connectivity are constrained: no flip may lose them. Half-edge 3 f + k runs from corner k
/// of face f to corner k + 1; its twin runs back in the face across.
class HalfedgeMesh {
 public:
  explicit HalfedgeMesh(const Adjacency& adjacency);

  const std::vector<Triangle>& faces() const { return faces_; }
  const std::vector<int>& twins() const { return twins_; }             // per half-edge, see twin()
  int id_count() const { return static_cast<int>(valences_.size()); }  // with those that are gone
  const std::vector<Triangle>& wedges() const {
    return wedges_.empty() ? faces_ : wedges_;
  }  // of the corners
  int half_edge_count() const { return static_cast<int>(twins_.size()); }

  int from(int h) const { return faces_[static_cast<size_t>(h / 3)][static_cast<size_t>(h % 3)]; }
  int to(int h) const { return from(next(h)); }
  int opposite_vertex(int h) const {
    return from(previous(h));
  }  // the corner across the half-edge in its face
  int twin(int h) const { return twins_[static_cast<size_t>(h)]; }  // -1 on the boundary
  int wedge(int h) const { return wedges()[static_cast<size_t>(h / 3)][static_cast<size_t>(h % 3)]; }
  static int next(int h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static int previous(int h) { return h % 3 == 0 ? h + 2 : h - 1; }

  /// Number of edges at the vertex.
  int valence(int vertex) const { return valences_[static_cast<size_t>(vertex)]; }

  /// A face that a collapse has removed: its half-edges join nothing and have no twins.
  bool is_gone(int face) const { return faces_[static_cast<size_t>(face)][0] < 0; }

  bool on_boundary(int vertex) const { return on_boundary_[static_cast<size_t>(vertex)] != 0; }

  /// The half-edges that leave the vertex, counter-clockwise; the first is the boundary one where there is
  /// one.
  ShortList outgoing(int vertex) const;

  /// The vertices that share an edge with this one, counter-clockwise.
  ShortList neighbours(int vertex) const;
  /// Those of them that leave from(h) between the same two creases or boundary edges as h; of those two the
  /// first is among them.
  ShortList sector(int h) const;

  /// Does a crease run through the vertex or end there?
  bool on_crease(int vertex) const;

  /// Does an edge join a and b?
  bool adjacent(int a, int b) const;

  /// Is the edge of h part of a crease?
  bool is_crease(int h) const { return constrained_[static_cast<size_t>(h)] != 0; }
  /// Or does it have no face on its other side?
  bool is_feature_edge(int h) const { return twin(h) < 0 || is_crease(h); }

  /// The edge of h comes to join the two corners across it.
  /// Pre-condition: h has a twin, is not constrained, and no edge joins those corners.
  void flip(int h);

  /// The half-edge of the flipped edge in the face of h, after flip(h).
  static int flipped(int h) { return h / 3 * 3 + 2; }

  /// Puts a new vertex on the edge of h and cuts the faces there in two. h comes to end in the vertex, whose
  /// id is the first new one and is returned. Both halves are constrained if the edge was; then the next id
  /// is the vertex's side on the right of h.
  int split(int h);

  /// May the ends of h become one vertex without a change of the topology, that of the creases included? The
  /// link condition: H. Edelsbrunner, "Geometry and topology for mesh generation", 2001. Holes, components
  /// and the pieces between creases keep at least a triangle.
  bool may_collapse(int h) const;

  /// Which side of `stays`, an end of h, the corner at which `spoke` leaves either end is to see when the
  /// edge of h collapses. Pre-condition: the other end has no sides but those along h.
  int side_after_collapse(int h, int stays, int spoke) const;

  /// Merges the other end of h into `stays`: that vertex and the faces of h are gone. Edges that fall
  /// together are constrained if one of them was. Pre-condition: may_collapse(h).
  void collapse(int h, int stays);

  /// Gives up the unused ids of vertices and faces and puts those that are left in an order in which
  /// neighbours are close together: see bfs_cluster_order(). Returns the old ids of the vertices in the new
  /// order. The sides keep their ids: set_wedges() is to follow where there are creases.
  std::vector<int> compact();

  /// Numbers the sides anew, as the connectivity of the same faces does.
  void set_wedges(const Adjacency& adjacency);

 private:
  int first_outgoing(int vertex) const;
  void link(int h, int twin);
  void split(int h, int vertex, int wedge);
  void close(int h);

  std::vector<Triangle> faces_;
  std::vector<Triangle> wedges_;  // empty without creases: they are the vertices
  std::vector<int> twins_;
  std::vector<int> outgoing_halfedge_;  // per id: one half-edge that leaves the vertex, -1 without faces
  std::vector<int> valences_;           // per id: -1 for a vertex that is gone and for a further side
  std::vector<char> on_boundary_;       // per id
  std::vector<char> constrained_;       // per half-edge
};

/// Its connectivity, without creases: quicker than from the faces alone. Pre-condition: no face is gone, and
/// there are so many vertices.
Adjacency connectivity_of(const HalfedgeMesh& halfedges, int vertex_count);

}  // namespace hooke
