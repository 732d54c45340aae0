// The local shape of a mesh on a surface, and its limits, for all that moves vertices or changes edges. Steps
// of many vertices are tested by integrator/guards.h, those of a single one by integrator/vertex_ring.h.
#pragma once

#include <algorithm>
#include <limits>

#include "hooke/geometry/triangle.h"

namespace hooke {

/// The defaults hold for all changes but collapses, which have some of their own. What is beyond a limit
/// already may stay so, but not become worse.
struct ShapeLimits {
  double area = .2;       // minimum area of a face after a step of its vertices, over the area before
  double alignment = .3;  // minimum cosine between face and surface normal
  double fold = .1;       // minimum cosine between the normals of adjacent faces
  double sagitta = .2;    // maximum sagitta of an edge over its target length
  /// Maximum cotangent of a face's minimum angle. Infinite: angles are free.
  double cotangent = std::numeric_limits<double>::infinity();
  double slack = 1e-7;  // by which cosines may still fall and sagittas over target lengths rise
};

/// Do the new area and alignment of a face break its limits?
inline bool face_breaks(const ShapeLimits& limits, double area_before, double area, double alignment_before,
                        double alignment) {
  const bool shrinks = area < limits.area * area_before;
  if (alignment_before >= limits.alignment) return shrinks || alignment < limits.alignment;
  // A folded face passes through zero area while it unfolds: any step is allowed that improves its alignment.
  return alignment < alignment_before - limits.slack || (shrinks && alignment <= alignment_before);
}

/// Does the new cotangent of a face's minimum angle break its limit? Folded faces are exempt: they pass
/// through zero area.
inline bool angle_breaks(const ShapeLimits& limits, double alignment_before, double before, double after) {
  return alignment_before >= limits.alignment && after > std::max(before, limits.cotangent);
}

/// Does the new sagitta of an edge break its limit?
inline bool sagitta_breaks(const ShapeLimits& limits, double target, double before, double after) {
  return after > std::max(before + limits.slack * target, limits.sagitta * target);
}

/// Does the new cosine across a crease break its limit? A crease keeps its angle except that one blunter than
/// a right angle stays blunter, and one of about a right angle does not become acute.
inline bool crease_fold_breaks(const ShapeLimits& limits, double before, double after) {
  const auto falls_below = [&](double limit) {
    return before >= limit - limits.slack && after < limit - limits.slack;
  };
  return falls_below(limits.fold) || falls_below(-limits.fold);
}

/// Does the new cosine across an edge that is no crease break its limit?
inline bool fold_breaks(const ShapeLimits& limits, double before, double after) {
  return after < std::min(limits.fold, before - limits.slack);
}

/// The worst values over the faces and edges that have been added.
struct LocalShape {
  double cotangent = 0;  // maximum, of the minimum angle of a face
  double alignment = 1;  // minimum cosine between face and surface normal
  double fold = 1;       // minimum cosine between the normals of adjacent faces
  double sagitta = 0;    // maximum of an edge over its target length

  /// `wedges` are the columns of the normals, see face_alignment() and edge_sagitta().
  void add_face(const Mat3X& points, const Mat3X& normals, const Triangle& face, const Triangle& wedges) {
    cotangent = std::max(cotangent, max_cotangent(points, face));
    alignment = std::min(alignment, face_alignment(points, normals, face, wedges));
  }
  void add_edge(const Mat3X& points, const Mat3X& normals, const Edge& edge, const Edge& wedges,
                double target) {
    sagitta = std::max(sagitta, edge_sagitta(points, normals, edge, wedges) / target);
  }
  void add_fold(double cosine) { fold = std::min(fold, cosine); }
};

/// Is the shape within the limits of cotangent, alignment, fold and sagitta?
inline bool is_within(const LocalShape& shape, const ShapeLimits& limits) {
  return shape.cotangent <= limits.cotangent && shape.alignment >= limits.alignment &&
         shape.fold >= limits.fold && shape.sagitta <= limits.sagitta;
}

/// The limits that also admit the shape before a change.
inline ShapeLimits loosened(ShapeLimits limits, const LocalShape& before) {
  limits.cotangent = std::max(limits.cotangent, before.cotangent);
  limits.alignment = std::min(limits.alignment, before.alignment);
  limits.fold = std::min(limits.fold, before.fold);
  limits.sagitta = std::max(limits.sagitta, before.sagitta);
  return limits;
}

}  // namespace hooke
