// What a step may do to one face or edge, from measures before and after.
#pragma once

#include <algorithm>
#include <limits>

namespace hooke {

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

}  // namespace hooke
