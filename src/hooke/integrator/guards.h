// Guards: limits on what a step may do to each face and edge, from measures before and after, and steps
// shortened per vertex until they respect the limits.
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
  double area_ratio = .2;  // minimum area of a face after a step, over its area before
  double alignment = .3;   // minimum cosine between face and surface normal; if smaller, it may only grow
  double fold = .1;        // minimum cosine between the normals of adjacent faces; likewise
  double sagitta = .2;     // maximum sagitta of an edge over its target length; if larger, it may only shrink
  /// Maximum cotangent of a face's smallest angle; if larger, it may only fall. Infinite: angles are free.
  double cotangent = std::numeric_limits<double>::infinity();
  double slack = 1e-7;  // by which cosines may still fall and sagittas over target lengths rise
  static constexpr int max_halvings = 8;  // of a vertex's displacement, before the vertex stays for this step
};

/// Do the new area and alignment of a face break its guard?
inline bool face_breaks(const GuardOptions& o, double area_before, double area, double alignment_before,
                        double alignment) {
  const bool shrinks = area < o.area_ratio * area_before;
  if (alignment_before >= o.alignment) return shrinks || alignment < o.alignment;
  // A folded face passes through zero area while it unfolds: any step is allowed that improves its alignment.
  return alignment < alignment_before - o.slack || (shrinks && alignment <= alignment_before);
}

/// Does the new cotangent of a face's smallest angle break its guard? Folded faces are exempt: they pass
/// through zero area.
inline bool angle_breaks(const GuardOptions& o, double alignment_before, double before, double after) {
  return alignment_before >= o.alignment && after > std::max(before, o.cotangent);
}

/// Does the new sagitta of an edge break its guard?
inline bool sagitta_breaks(const GuardOptions& o, double target, double before, double after) {
  return after > std::max(before + o.slack * target, o.sagitta * target);
}

/// Does the new cosine across a crease break its guard? A crease keeps its angle except that one blunter than
/// a right angle stays blunter, and one of about a right angle does not become acute.
inline bool crease_fold_breaks(const GuardOptions& o, double before, double after) {
  const auto falls_below = [&](double limit) { return before >= limit - o.slack && after < limit - o.slack; };
  return falls_below(o.fold) || falls_below(-o.fold);
}

/// Does the new cosine across an edge that is no crease break its guard?
inline bool fold_breaks(const GuardOptions& o, double before, double after) {
  return after < std::min(o.fold, before - o.slack);
}

/// Tests displacements by their effect on each face and edge, with the normals of the wedge on the same side
/// of a crease. Measures lazily: most steps respect the absolute limits, whatever the state before. Keeps
/// references to the adjacency and the targets.
class Guards {
 public:
  Guards(const Adjacency& adjacency, const TargetLengths& targets, const GuardOptions& options)
      : adjacency_(adjacency), targets_(targets), options_(options) {}

  /// to = from + displacement, projected and within the guards: offending vertices halve their displacement,
  /// and finally stay. On return `displacement` holds what was applied. Returns the vertices that were
  /// limited.
  std::vector<int> step(Retraction& retraction, const SurfacePositions& from, Mat3X& displacement,
                        SurfacePositions& to, Stopwatch* stopwatch = nullptr) const;

  /// The vertices of all faces and edges for which a guard breaks between `from` and `to`, ascending.
  std::vector<int> offenders(const SurfacePositions& from, const SurfacePositions& to) const;

  /// The same around the vertices `moved`, when no others moved.
  std::vector<int> offenders_around(const SurfacePositions& from, const SurfacePositions& to,
                                    const std::vector<int>& moved) const;

  const GuardOptions& options() const { return options_; }

  /// Faces whose alignment with the surface is below the limit, ascending.
  std::vector<int> folded_faces(const SurfacePositions& positions) const;

  /// The vertices of faces and edges at or beyond a limit, ascending. The angle limit does not count.
  std::vector<int> vertices_at_limits(const SurfacePositions& positions) const;

 private:
  double alignment(const SurfacePositions& positions, size_t face) const;
  double sagitta(const SurfacePositions& positions, size_t edge) const;
  double fold(const SurfacePositions& positions, size_t edge) const;
  bool face_breaks(const SurfacePositions& from, const SurfacePositions& to, size_t face) const;
  bool fold_breaks(const SurfacePositions& from, const SurfacePositions& to, size_t edge) const;
  bool edge_breaks(const SurfacePositions& from, const SurfacePositions& to, size_t edge) const;
  void add_corners(int face, std::vector<int>& vertices) const;
  void add_vertices_around(int edge, bool folds, std::vector<int>& vertices) const;

  const Adjacency& adjacency_;
  const TargetLengths& targets_;
  GuardOptions options_;
};

}  // namespace hooke
