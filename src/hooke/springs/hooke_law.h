// The modified Hooke's law [4] and its potential, for lengths, altitudes and angles alike.
// "Hooke's Optimization for 3D triangular mesh", section 3.1.
#pragma once

#include <cmath>
#include <numbers>

namespace hooke {

inline constexpr double altitude_ratio = std::numbers::sqrt3 / 2;  // of an equilateral triangle

/// Minimum length over the target: springs of no length have a force instead of NaN.
inline constexpr double min_relative_length = 1e-9;

/// A potential and its derivative by the quantity that it depends on.
struct Potential {
  double value = 0;
  double slope = 0;  // dU/dl; the force along the growing quantity is -slope
};

/// U(l; L): (l - L)^2 / 2 for l >= L, L (L ln(L/l) - (L - l)) for l < L; C2 at L, infinite at l = 0. [4]
inline Potential spring_potential(double l, double L) {
  if (l >= L) return {.5 * (l - L) * (l - L), l - L};
  return {L * (L * std::log(L / l) - (L - l)), L * (l - L) / l};
}

}  // namespace hooke
