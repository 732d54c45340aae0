// Feature curves: the boundaries and creases of the input as polylines, along which vertices slide.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "hooke/core/types.h"

namespace hooke {

/// A polyline of the input along which vertices slide: open between two corners, or closed.
struct Curve {
  Mat3X points;
  Mat3X tangents;  // unit, at the points; the mean of the segments that meet there
  bool closed = false;

  int segment_count() const { return static_cast<int>(points.cols()) - (closed ? 0 : 1); }
};

/// A place on a curve.
struct CurveProjection {
  Vec3 point;
  Vec3 tangent;  // unit
  int segment = 0;
};

/// Closest point of the curve to x, found by walking from `segment`.
CurveProjection project_to_curve(const Curve& curve, const Vec3& x, int segment);

/// The curves of the input by the points they pass through: an edge between two corners does not say along
/// which curve it runs.
class CurveFinder {
 public:
  struct Place {
    int curve = -1;
    int segment = 0;
  };

  explicit CurveFinder(const std::vector<Curve>& curves);

  /// The curve that has both points, which are points of the input; curve -1 if there is none. Where there
  /// are several, the one closest to the middle of the two.
  Place common(const Vec3& a, const Vec3& b) const;

 private:
  const std::vector<Curve>* curves_;
  std::map<std::array<double, 3>, std::vector<Place>> places_;
};

/// How many edges each curve has, and how many it is to have.
struct CurveEdges {
  std::vector<int> present, wanted;
};

/// Edges for the curve: one per target length, and as many more as it takes to keep the chords within
/// `chord_error` target lengths of the curve, but no more than it has segments.
int wanted_edges(const Curve& curve, double target, double chord_error);

}  // namespace hooke
