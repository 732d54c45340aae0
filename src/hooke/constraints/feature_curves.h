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

Curve make_curve(Mat3X points, bool closed);

/// Does a polyline through these points turn by more than the angle with this cosine?
bool turns(const Vec3& before, const Vec3& at, const Vec3& after, double cosine);

/// Indices of the points at the bends of an even curve: farther than .01 mean edge lengths from the chord
/// between their neighbours. None if the longest edge is more than `even` times the shortest.
std::vector<int> bends_of_even_curve(const Curve& curve, double even);

/// A point projected to a curve.
struct CurveProjection {
  Vec3 point;
  Vec3 tangent;     // unit
  int segment = 0;  // segment of the curve on which the point lies
};

/// Closest point of the curve to x, found by a local search from `segment`.
CurveProjection project_to_curve(const Curve& curve, const Vec3& x, int segment);

/// Finds the curves of the input by the points they pass through: the two corners of an edge do not tell
/// along which curve it runs. Keeps a reference to the curves, which must outlive it.
class CurveFinder {
 public:
  struct Location {
    int curve = -1;
    int segment = 0;
  };

  explicit CurveFinder(const std::vector<Curve>& curves);

  /// The curve through both points, which are points of the input; curve -1 if there is none. Of several, the
  /// one closest to the midpoint.
  Location common(const Vec3& a, const Vec3& b) const;

 private:
  const std::vector<Curve>* curves_;
  std::map<std::array<double, 3>, std::vector<Location>> locations_;
};

/// Present and target number of edges of each curve.
struct CurveEdges {
  std::vector<int> present, target;
};

/// Target number of edges of the curve: one per target length, and, up to the number of its segments, as many
/// more as it takes to keep the chords within `chord_error` target lengths of the curve.
int target_edge_count(const Curve& curve, double target_length, double chord_error);

}  // namespace hooke
