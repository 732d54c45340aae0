#include "hooke/geometry/triangle_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hooke {
namespace {

/// Twice the area: by the two shorter edges, whose cross product has the least rounding.
double doubled_area(const Vec3& ab, const Vec3& bc, const Vec3& ca, const Vec3& lengths) {
  Eigen::Index longest = 0;
  lengths.maxCoeff(&longest);
  return (longest == 0 ? bc.cross(ca) : longest == 1 ? ca.cross(ab) : ab.cross(bc)).norm();
}

/// Degrees; 0 when an edge has no length. The arc tangent keeps all digits near 0 and 180, where that of the
/// cosine loses half of them.
double angle_of(double product, double doubled_area) {
  return std::atan2(doubled_area, product + 0.) * (180 / std::numbers::pi);  // atan2(0, -0) would be 180
}

}  // namespace

TriangleShape measure_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, bc = c - b, ca = a - c;
  const Vec3 lengths(ab.norm(), bc.norm(), ca.norm());
  const double x = lengths[0], y = lengths[1], z = lengths[2];
  const auto [shortest, longest] = std::minmax({x, y, z});
  const double twice = doubled_area(ab, bc, ca, lengths), area = .5 * twice;
  const auto [least, greatest] = std::minmax({-ab.dot(ca), -bc.dot(ab), -ca.dot(bc)});
  const double perimeter = x + y + z;
  const double squares = x * x + y * y + z * z;

  TriangleShape t;
  t.min_angle = angle_of(greatest, twice);
  t.max_angle = angle_of(least, twice);
  t.shape = squares > 0 ? 4 * std::numbers::sqrt3 * area / squares : 0;
  t.radius_ratio = (x / area) * (y / area) * z * perimeter / 16;  // R = xyz / 4A, r = 2A / perimeter
  t.aspect_ratio = longest * perimeter / (4 * std::numbers::sqrt3 * area);
  t.edge_ratio = longest / shortest;
  return t;
}

}  // namespace hooke
