// Distances of four points at a time to one face. To the last bit those of closest_point() of the tree.
#pragma once

#include <limits>

#include "hooke/core/lanes.h"
#include "hooke/geometry/bounding_volume_tree.h"

namespace hooke {

/// Times this, what is a lower bound but for rounding surely is one.
constexpr double surely = 1 - 1e-9;

/// A face and all about it that is the same for every point.
struct PreparedFace {
  PreparedFace() = default;
  PreparedFace(const BoundingVolumeTree::Face& face, size_t its_place)
      : corners(face.corners), place(static_cast<long long>(its_place)) {
    const auto& [a, b, c] = corners;
    normal = (b - a).cross(c - a);
    double longest = 0;
    for (size_t k = 0; k < 3; ++k) {
      sides[k] = corners[(k + 1) % 3] - corners[k];
      squared_sides[k] = sides[k].squaredNorm();
      longest = std::max(longest, squared_sides[k]);
      if (!(squared_sides[k] > 0)) squared_sides[k] = 1;
      beside[k] = normal.cross(sides[k]);
    }
    const double nn = normal.squaredNorm();
    has_area = nn > least_triangle_squared_area * longest * longest;
    squared_normal = has_area ? nn : 1;
    if (!(nn > least_for_bounds * longest * longest)) return;
    height_weight = 1 / nn;
    beside_weight = height_weight / longest;  // of the longest side: less than that of the others
  }

  /// Rounding of a thin triangle's normal could make a bound of it too large.
  static constexpr double least_for_bounds = 1e-4;

  std::array<Vec3, 3> corners;
  long long place = 0;
  Vec3 normal;
  std::array<Vec3, 3> sides;  // from corner k to corner k + 1
  std::array<double, 3> squared_sides;
  std::array<Vec3, 3> beside;  // in the plane, off side k to the inside
  bool has_area = false;
  double squared_normal = 1;
  // Squares times these are squared distances; 0 where they would not be trusted.
  double beside_weight = 0;
  double height_weight = 0;
};

/// Added in Eigen's order, so that the results are the same as those of closest_point().
HOOKE_INLINE void dot(const LaneVec& a, const Vec3& b, Lanes& product) {
  product = a.x * b[0] + a.y * b[1] + a.z * b[2];
}
HOOKE_INLINE void difference(const LaneVec& x, const Vec3& a, LaneVec& d) {
  d = {x.x - a[0], x.y - a[1], x.z - a[2]};
}

HOOKE_INLINE void distances_to_side(const PreparedFace& face, size_t k, const LaneVec& x,
                                    const LaneVec& from_corner, Lanes& squared) {
  const Vec3 &a = face.corners[k], &d = face.sides[k];
  const Lanes zero = {}, one = zero + 1.;
  Lanes t;
  dot(from_corner, d, t);
  t /= zero + face.squared_sides[k];
  t = t > zero ? t : zero;
  t = t < one ? t : one;
  const LaneVec way = {x.x - (a[0] + t * d[0]), x.y - (a[1] + t * d[1]), x.z - (a[2] + t * d[2])};
  dot(way, way, squared);
}

/// Of faces at the same distance the first one wins.
HOOKE_INLINE void try_face(const PreparedFace& face, const LaneVec& x, Lanes& best, LaneMask& places) {
  std::array<LaneVec, 3> from;
  std::array<Lanes, 3> beside;
  Lanes height, outside = {};
  for (size_t k = 0; k < 3; ++k) {
    difference(x, face.corners[k], from[k]);
    dot(from[k], face.beside[k], beside[k]);
    outside = outside < beside[k] ? outside : beside[k];
  }
  dot(from[0], face.normal, height);
  const Lanes bound =
      (height * height * face.height_weight + outside * outside * face.beside_weight) * surely;
  const LaneMask promising = bound <= best;
  if (!any(promising)) return;

  const LaneMask everywhere = ~LaneMask{}, nowhere = {};
  const LaneMask inside =
      ((beside[0] >= 0.) & (beside[1] >= 0.) & (beside[2] >= 0.)) & (face.has_area ? everywhere : nowhere);
  Lanes squared = height * height / (Lanes{} + face.squared_normal);
  Lanes to_side = Lanes{} + std::numeric_limits<double>::infinity(), other;
  if (any(promising & ~inside)) {
    distances_to_side(face, 0, x, from[0], to_side);
    distances_to_side(face, 1, x, from[1], other);
    to_side = other < to_side ? other : to_side;
    distances_to_side(face, 2, x, from[2], other);
    to_side = other < to_side ? other : to_side;
  }
  squared = inside ? squared : to_side;
  const LaneMask closer = (squared < best) | ((squared == best) & (places > face.place));
  best = closer ? squared : best;
  places = closer ? face.place + LaneMask{} : places;
}

}  // namespace hooke
