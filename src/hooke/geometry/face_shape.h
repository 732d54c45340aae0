// Area and normal of one triangle, and when it has none.
#pragma once

#include <algorithm>

#include "hooke/core/types.h"

namespace hooke {

struct FaceShape {
  double area = 0;
  Vec3 normal = Vec3::Zero();  // unit, outward; zero where the face is degenerate
  Vec3 centre = Vec3::Zero();  // mean of the corners

  bool degenerate() const { return normal.isZero(0); }
};

/// Its length is twice the area.
inline Vec3 doubled_area_vector(const Mat3X& points, const Triangle& face) {
  const Vec3 a = points.col(face[0]);
  return (points.col(face[1]) - a).cross(points.col(face[2]) - a);
}

/// A face is degenerate when its double area is below 1e-12 of its longest edge squared: then rounding of the
/// coordinates decides where its normal points.
inline FaceShape face_shape(const Eigen::Ref<const Mat3X>& points, const Triangle& face) {
  const Vec3 a = points.col(face[0]), b = points.col(face[1]), c = points.col(face[2]);
  const Vec3 cross = (b - a).cross(c - a);
  const double double_area = cross.norm();
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  FaceShape shape{.5 * double_area, Vec3::Zero(), (a + b + c) / 3};
  if (double_area > 1e-12 * longest) shape.normal = cross / double_area;
  return shape;
}

}  // namespace hooke
