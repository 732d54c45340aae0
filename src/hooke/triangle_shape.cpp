#include "hooke/triangle_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hooke {
namespace {

/// Degrees between two vectors, 0 when one has no length. atan2 keeps all digits near 0 and 180, where acos
/// loses half of them.
double angle_between(const Vec3& u, const Vec3& v) {
  const double product = u.dot(v) + 0.;  // turns -0 into 0: atan2(0, -0) would be 180 degrees
  return std::atan2(u.cross(v).norm(), product) * (180 / std::numbers::pi);
}

}  // namespace

TriangleShape measure_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, bc = c - b, ca = a - c;
  const auto [least, greatest] =
      std::minmax({angle_between(ab, -ca), angle_between(bc, -ab), angle_between(ca, -bc)});
  const double x = ab.norm(), y = bc.norm(), z = ca.norm();
  const auto [shortest, longest] = std::minmax({x, y, z});
  const double area = .5 * ab.cross(-ca).norm();
  const double perimeter = x + y + z;
  const double squares = x * x + y * y + z * z;

  TriangleShape t;
  t.min_angle = least;
  t.max_angle = greatest;
  t.shape = squares > 0 ? 4 * std::numbers::sqrt3 * area / squares : 0;
  t.radius_ratio = (x / area) * (y / area) * z * perimeter / 16;  // R = xyz / 4A, r = 2A / perimeter
  t.aspect_ratio = longest * perimeter / (4 * std::numbers::sqrt3 * area);
  t.edge_ratio = longest / shortest;
  return t;
}

}  // namespace hooke
