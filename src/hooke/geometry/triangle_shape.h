// Measures of a single triangle. Those that need an area are infinite or NaN without one.
// P. P. Pebay and T. J. Baker, "Analysis of triangle quality measures", 2003.
#pragma once

#include "hooke/core/types.h"

namespace hooke {

struct TriangleShape {
  double min_angle = 0;     // degrees, 60 at best
  double max_angle = 0;     // degrees, 60 at best
  double shape = 0;         // 4 sqrt(3) area / (sum of squared edges): 1 at best, 0 without area
  double radius_ratio = 0;  // circumradius / (2 inradius): 1 at best, unbounded
  double aspect_ratio = 0;  // longest edge / (2 sqrt(3) inradius): 1 at best, unbounded
  double edge_ratio = 0;    // longest edge / shortest edge: 1 at best, unbounded
};

TriangleShape measure_triangle(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace hooke
