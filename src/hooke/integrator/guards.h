// What a step may do to one face or edge, from measures before and after.
#pragma once

#include <algorithm>
#include <limits>

#include "hooke/core/types.h"

namespace hooke {

struct Adjacency;
struct SurfacePositions;
class Retraction;
class Stopwatch;
struct TargetLengths;

struct GuardOptions {
  double area_ratio = .2;  // a face keeps at least this part of its area in a step
  double alignment = .3;   // least cosine between a face and the surface under it; below, it may only grow
  double fold = .1;        // least cosine between two neighbouring faces; below, it may only grow
  double sagitta = .2;     // greatest sagitta of an edge over its target length; above, it may only shrink
  // Greatest cotangent of a face's least angle; above, it may only fall. Infinite: angles are free.
  double cotangent = std::numeric_limits<double>::infinity();
  double slack = 1e-7;   // by which a cosine may still fall, or a sagitta over its target length rise
  int max_halvings = 8;  // of a vertex's step, before it stands still for this step
};

inline bool face_breaks(const GuardOptions& o, double area_before, double area, double alignment_before,
                        double alignment) {
  const bool shrinks = area < o.area_ratio * area_before;
  if (alignment_before >= o.alignment) return shrinks || alignment < o.alignment;
  // A folded face passes through zero area on its way back: it may do all that turns it the right way.
  return alignment < alignment_before - o.slack || (shrinks && alignment <= alignment_before);
}

/// Only faces on the surface: a folded one passes through zero area.
inline bool angle_breaks(const GuardOptions& o, double alignment_before, double before, double after) {
  return alignment_before >= o.alignment && after > std::max(before, o.cotangent);
}

inline bool sagitta_breaks(const GuardOptions& o, double target, double before, double after) {
  return after > std::max(before + o.slack * target, o.sagitta * target);
}

/// A crease may be as sharp as it is, but one that is blunter than a right angle stays so, and one of about a
/// right angle does not become an acute one.
inline bool crease_fold_breaks(const GuardOptions& o, double before, double after) {
  const auto falls_below = [&](double limit) { return before >= limit - o.slack && after < limit - o.slack; };
  return falls_below(o.fold) || falls_below(-o.fold);
}

inline bool fold_breaks(const GuardOptions& o, double before, double after) {
  return after < std::min(o.fold, before - o.slack);
}

// Acceptance per vertex: what a step may do to each face and edge, and the step that obeys.

/// Judges steps by what they do to each face and edge, each on its own side of a crease. Measures what it
/// needs when it needs it: most steps stay within the absolute limits, whatever was before. Keeps references
/// to the connectivity and the targets.
class Guards {
 public:
  Guards(const Adjacency& adjacency, const TargetLengths& targets, const GuardOptions& options)
      : adjacency_(adjacency), targets_(targets), options_(options) {}

  /// to = from + displacement, retracted and obeying the guards: offending vertices halve their steps, then
  /// stand still; `displacement` becomes what was asked for in the end. Returns the vertices that were held
  /// back.
  std::vector<int> step(Retraction& retraction, const SurfacePositions& from, Mat3X& displacement,
                        SurfacePositions& to, Stopwatch* stopwatch = nullptr) const;

  /// The vertices of all faces and edges that break a guard on the way from one placement to the other,
  /// ascending.
  std::vector<int> offenders(const SurfacePositions& from, const SurfacePositions& to) const;

  /// Those about vertices that moved, where no others did.
  std::vector<int> offenders_around(const SurfacePositions& from, const SurfacePositions& to,
                                    const std::vector<int>& moved) const;

  const GuardOptions& options() const { return options_; }

  /// Faces that lie against the surface (alignment below the threshold), ascending.
  std::vector<int> folded_faces(const SurfacePositions& positions) const;

  /// The vertices of faces and edges that are at a limit or beyond it. Angles have none here.
  std::vector<int> vertices_at_limits(const SurfacePositions& positions) const;

 private:
  double alignment(const SurfacePositions& positions, size_t face) const;
  double sagitta(const SurfacePositions& positions, size_t edge) const;
  double fold(const SurfacePositions& positions, size_t edge) const;
  bool face_breaks(const SurfacePositions& from, const SurfacePositions& to, size_t face) const;
  bool fold_breaks(const SurfacePositions& from, const SurfacePositions& to, size_t edge) const;
  bool edge_breaks(const SurfacePositions& from, const SurfacePositions& to, size_t edge) const;
  void add_corners(int face, std::vector<int>& vertices) const;
  void add_vertices_about(int edge, bool folds, std::vector<int>& vertices) const;

  const Adjacency& adjacency_;
  const TargetLengths& targets_;
  GuardOptions options_;
};

}  // namespace hooke
