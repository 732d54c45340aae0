// Exact geometric predicates: the signs of orientation determinants for all finite coordinates.
// J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates", 1997
// (the error bounds of the fast path).
#pragma once

#include "hooke/core/types.h"

namespace hooke {

using Vec2 = Eigen::Vector2d;

/// Orientation of (a, b, c): 1 if counter-clockwise, 0 if collinear, -1 if clockwise.
int orient2d(const Vec2& a, const Vec2& b, const Vec2& c);

/// Side of the plane (a, b, c) on which d lies: 1 in the direction of the normal (b - a) x (c - a), 0 on the
/// plane (or if a, b and c are collinear), -1 behind.
int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Whether a, b and c are exactly collinear: the triangle has no area.
bool is_collinear(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace hooke
