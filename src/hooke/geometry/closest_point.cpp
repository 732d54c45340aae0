#include "hooke/geometry/closest_point.h"

#include <algorithm>

namespace hooke {
namespace {

/// Parameter in [0, 1] of the point of the segment a b closest to x.
double closest_parameter(const Vec3& a, const Vec3& b, const Vec3& x) {
  const Vec3 ab = b - a;
  const double length2 = ab.squaredNorm();
  return length2 > 0 ? std::clamp((x - a).dot(ab) / length2, 0., 1.) : 0;
}

}  // namespace

TrianglePoint closest_point_on_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& x) {
  const Vec3 normal = (b - a).cross(c - a);
  const double area2 = normal.squaredNorm();
  if (area2 > 0) {
    const Vec3 weights = Vec3((c - b).cross(x - b).dot(normal), (a - c).cross(x - c).dot(normal),
                              (b - a).cross(x - a).dot(normal)) /
                         area2;
    if (weights.minCoeff() >= 0) {
      const Vec3 point = weights[0] * a + weights[1] * b + weights[2] * c;
      return {point, weights, (point - x).squaredNorm()};
    }
  }

  // Outside, or without area: on one of the sides.
  const std::array<Vec3, 3> corners = {a, b, c};
  TrianglePoint best;
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    const Vec3 &from = corners[static_cast<std::size_t>(k)], &to = corners[static_cast<std::size_t>(next)];
    const double t = closest_parameter(from, to, x);
    const Vec3 point = from + t * (to - from);
    const double squared_distance = (point - x).squaredNorm();
    if (k > 0 && squared_distance >= best.squared_distance) continue;
    best.point = point;
    best.squared_distance = squared_distance;
    best.weights.setZero();
    best.weights[k] = 1 - t;
    best.weights[next] = t;
  }
  return best;
}

double distance_to_segment(const Vec3& x, const Vec3& a, const Vec3& b) {
  return (x - a - closest_parameter(a, b, x) * (b - a)).norm();
}

}  // namespace hooke
