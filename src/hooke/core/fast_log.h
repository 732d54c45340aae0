// Functions of four numbers at a time: the natural logarithm and the angle of a vector.
#pragma once

#include "hooke/core/lanes.h"

namespace hooke {

/// 1/3 + q/5 + q^2/7 + ... + q^((last - 3) / 2) / last, by Horner's rule.
template <int last>
HOOKE_INLINE void sum_odd_series(const Lanes& q, Lanes& series) {
  series = Lanes{} + 1. / last;
#pragma GCC unroll 16
  for (int n = last - 2; n >= 3; n -= 2) series = q * series + 1. / n;
}

/// x := log x, to a relative error of some 1e-15. Pre-condition: finite, positive and not subnormal.
HOOKE_INLINE void take_log(Lanes& x) {
  using Bits = long long __attribute__((vector_size(32)));
  // x = 2^e m with m from sqrt(1/2) to sqrt(2); the offset makes the mantissa wrap at sqrt(2) instead of 2.
  constexpr long long one = 0x3ff0000000000000, sqrt_half = 0x3fe6a09e667f3bcd, mantissa = 0xfffffffffffff;
  const Bits shifted = reinterpret_cast<Bits>(x) + (one - sqrt_half);
  const Lanes m = reinterpret_cast<Lanes>((shifted & mantissa) + sqrt_half);
  // An integer below 2^52 in the mantissa of 2^52 is that integer plus 2^52.
  constexpr long long two_to_52 = 0x4330000000000000;
  const Lanes e = reinterpret_cast<Lanes>((shifted >> 52) | two_to_52) - (4503599627370496. + 1023.);

  // log m = 2 artanh s, |s| < .172.
  const Lanes s = (m - 1.) / (m + 1.);
  const Lanes q = s * s;
  Lanes series;
  sum_odd_series<17>(q, series);
  constexpr double log_2 = 0.6931471805599453;
  x = e * log_2 + 2. * s * (1. + q * series);
}

/// The angle between the vector (x, y) and the first axis, to a relative error of some 1e-15 up to 90
/// degrees. Pre-condition: y > 0; r is the vector's length.
HOOKE_INLINE void take_angle(const Lanes& x, const Lanes& y, const Lanes& r, Lanes& angle) {
  Lanes t = y / (r + x);  // tan of the half angle, then of the quarter, then of the eighth
  for (int halving = 0; halving < 2; ++halving) {
    Lanes root = 1. + t * t;
    take_sqrt(root);
    t = t / (1. + root);
  }
  const Lanes q = -t * t;
  Lanes series;
  sum_odd_series<23>(q, series);
  angle = 8. * t * (1. + q * series);
}

}  // namespace hooke
