// Triangles whose edges can be flipped: who lies across each edge, in flat arrays. Faces and vertices keep
// their ids; a flip reuses the ids of the two faces it joins.
#pragma once

#include "hooke/connectivity.h"

namespace hooke {

/// Creases of the connectivity are constrained from the start. Half-edge 3 f + k runs from corner k of face f
/// to corner k + 1; its twin runs back in the face across.
class Triangulation {
 public:
  explicit Triangulation(const Connectivity& connectivity);

  const std::vector<Triangle>& faces() const { return faces_; }
  const std::vector<Triangle>& sides() const { return sides_.empty() ? faces_ : sides_; }  // of the corners
  int half_edge_count() const { return static_cast<int>(twins_.size()); }

  int from(int h) const { return faces_[static_cast<size_t>(h / 3)][static_cast<size_t>(h % 3)]; }
  int to(int h) const { return from(next(h)); }
  int apex(int h) const { return from(previous(h)); }  // the corner across the half-edge in its face
  int twin(int h) const { return twins_[static_cast<size_t>(h)]; }  // -1 on the boundary
  int side(int h) const { return sides()[static_cast<size_t>(h / 3)][static_cast<size_t>(h % 3)]; }
  static int next(int h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static int previous(int h) { return h % 3 == 0 ? h + 2 : h - 1; }

  /// Number of edges at the vertex.
  int valence(int vertex) const { return valences_[static_cast<size_t>(vertex)]; }

  bool on_boundary(int vertex) const { return on_boundary_[static_cast<size_t>(vertex)] != 0; }

  /// The half-edges that leave the vertex, counter-clockwise; the first is the boundary one where there is
  /// one.
  std::vector<int> outgoing(int vertex) const;

  /// Those of them that leave from(h) between the same two creases or boundary edges as h; of those two the
  /// first is among them.
  std::vector<int> sector(int h) const;

  /// Does a crease run through the vertex or end there?
  bool on_crease(int vertex) const;

  /// Does an edge join a and b?
  bool adjacent(int a, int b) const;

  /// Marks the edge of h, in both its faces, as one that is never flipped: a crease. Flips of other edges
  /// keep the mark.
  void constrain(int h);
  bool is_constrained(int h) const { return constrained_[static_cast<size_t>(h)] != 0; }

  /// The edge of h comes to join the two corners across it.
  /// Pre-condition: h has a twin, is not constrained, and no edge joins those corners.
  void flip(int h);

  /// The half-edge of the flipped edge in the face of h, after flip(h).
  static int flipped(int h) { return h / 3 * 3 + 2; }

 private:
  void link(int h, int twin);

  std::vector<Triangle> faces_;
  std::vector<Triangle> sides_;  // empty without creases: they are the vertices
  std::vector<int> twins_;
  std::vector<int> leaving_;  // per vertex: one half-edge that leaves it, -1 without faces
  std::vector<int> valences_;
  std::vector<char> on_boundary_;
  std::vector<char> constrained_;  // per half-edge
};

}  // namespace hooke
