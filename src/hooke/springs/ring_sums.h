// Sums over a ring in lanes: an energy, and its derivatives along two directions.
#pragma once

#include "hooke/core/lanes.h"
#include "hooke/core/types.h"

namespace hooke {

struct RingSums {
  Lanes energy = {}, gu = {}, gv = {}, huu = {}, huv = {}, hvv = {};
};

/// Components of a vector along the two directions.
struct LanePair {
  Lanes u, v;
};

struct Directions {
  Vec3 u, v;
};

HOOKE_INLINE void along(const LaneVec& x, const Directions& d, LanePair& p) {
  p.u = x.x * d.u[0] + x.y * d.u[1] + x.z * d.u[2];
  p.v = x.x * d.v[0] + x.y * d.v[1] + x.z * d.v[2];
}

/// Adds weight * a a^T to the second derivatives.
HOOKE_INLINE void add_square(const Lanes& weight, const LanePair& a, RingSums& s) {
  s.huu += weight * a.u * a.u;
  s.huv += weight * a.u * a.v;
  s.hvv += weight * a.v * a.v;
}

/// Adds weight * (a b^T + b a^T).
HOOKE_INLINE void add_product(const Lanes& weight, const LanePair& a, const LanePair& b, RingSums& s) {
  s.huu += 2. * weight * a.u * b.u;
  s.huv += weight * (a.u * b.v + a.v * b.u);
  s.hvv += 2. * weight * a.v * b.v;
}

/// Adds weight * the unit matrix in the two directions; a missing one has none.
HOOKE_INLINE void add_unit(const Lanes& weight, const Directions& d, RingSums& s) {
  s.huu += weight;
  s.hvv += weight * d.v.squaredNorm();
}

}  // namespace hooke
