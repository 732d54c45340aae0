// Signs of determinants, exact for all finite coordinates.
// J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates", 1997
// (the error bounds of the fast path).
#pragma once

#include "hooke/core/types.h"

namespace hooke {

using Vec2 = Eigen::Vector2d;

/// Sign of the area of (a, b, c): 1 when counter-clockwise, 0 when on one line, -1 when clockwise.
int orient2d(const Vec2& a, const Vec2& b, const Vec2& c);

/// On which side of the plane (a, b, c) the point d lies: 1 where the normal (b - a) x (c - a) points, 0 on
/// the plane (or when a, b and c lie on one line), -1 behind.
int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Does the triangle have no area at all?
bool is_collinear(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace hooke
