// Closest point of one triangle. For the nearest of many see bounding_volume_tree.h.
#pragma once

#include "hooke/core/types.h"

namespace hooke {

struct TrianglePoint {
  Vec3 point;
  Vec3 weights;  // barycentric: point = weights[0] a + weights[1] b + weights[2] c, none negative
  double squared_distance = 0;
};

/// The point of the triangle a b c that is closest to x. The triangle may be degenerate.
TrianglePoint closest_point_on_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& x);

/// Distance of x to the segment a b, which may have no length.
double distance_to_segment(const Vec3& x, const Vec3& a, const Vec3& b);

}  // namespace hooke
