// SIMD vectors of four doubles for the inner loops, with products of 3-vectors, logarithm and angle.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

// Functions marked with this are compiled by GCC with and without AVX2; the processor selects the version at
// program start. Neither uses fused multiply-add: both give the same results. (Clang 14 links no clones, and
// what selects them runs before the thread sanitizer can.)
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__)
#define HOOKE_SIMD [[gnu::target_clones("avx2", "default")]]
#else
#define HOOKE_SIMD
#endif
// Lanes have no portable calling convention: functions take them by reference and are always inlined.
#define HOOKE_INLINE [[gnu::always_inline]] inline

namespace hooke {

/// Four doubles; + - * / and comparisons act elementwise. They take one register with AVX2 and two without;
/// the results are the same.
using Lanes = double __attribute__((vector_size(32)));
using LaneMask = long long __attribute__((vector_size(32)));  // result of a comparison: -1 or 0 in each lane
constexpr std::size_t lane_count = 4;

/// `count` rounded up to a multiple of the number of lanes.
constexpr std::size_t padded_to_lanes(std::size_t count) {
  return (count + lane_count - 1) / lane_count * lane_count;
}

HOOKE_INLINE void load(const double* from, Lanes& x) {
  std::memcpy(&x, from, sizeof(Lanes));
}
HOOKE_INLINE void load(const std::int32_t* from, Lanes& x) {
  using Ints = std::int32_t __attribute__((vector_size(16)));
  Ints ints;
  std::memcpy(&ints, from, sizeof(Ints));
  x = __builtin_convertvector(ints, Lanes);
}
HOOKE_INLINE void store(const Lanes& x, double* to) {
  std::memcpy(to, &x, sizeof(Lanes));
}
HOOKE_INLINE void take_sqrt(Lanes& x) {
  x = Lanes{std::sqrt(x[0]), std::sqrt(x[1]), std::sqrt(x[2]), std::sqrt(x[3])};
}
HOOKE_INLINE bool any(const LaneMask& m) {
  return (m[0] | m[1] | m[2] | m[3]) != 0;
}
HOOKE_INLINE double sum_of(const Lanes& x) {
  return (x[0] + x[1]) + (x[2] + x[3]);
}

/// Four 3-vectors, one per lane.
struct LaneVec {
  Lanes x, y, z;
};
HOOKE_INLINE void load(const double* x, std::size_t stride, LaneVec& v) {
  load(x, v.x);
  load(x + stride, v.y);
  load(x + 2 * stride, v.z);
}
HOOKE_INLINE void store(const LaneVec& v, double* x, std::size_t stride) {
  store(v.x, x);
  store(v.y, x + stride);
  store(v.z, x + 2 * stride);
}
HOOKE_INLINE void dot(const LaneVec& a, const LaneVec& b, Lanes& product) {
  product = a.x * b.x + a.y * b.y + a.z * b.z;
}
HOOKE_INLINE void cross(const LaneVec& a, const LaneVec& b, LaneVec& product) {
  product.x = a.y * b.z - a.z * b.y;
  product.y = a.z * b.x - a.x * b.z;
  product.z = a.x * b.y - a.y * b.x;
}

/// 1/3 + q/5 + q^2/7 + ... + q^((last - 3) / 2) / last, by Horner's rule.
template <int last>
HOOKE_INLINE void sum_odd_series(const Lanes& q, Lanes& series) {
  series = Lanes{} + 1. / last;
#pragma GCC unroll 16
  for (int n = last - 2; n >= 3; n -= 2) series = q * series + 1. / n;
}

/// x := ln x, with a relative error of about 1e-15. Some number where x is not finite, positive and normal.
HOOKE_INLINE void take_log(Lanes& x) {
  using Bits = unsigned long long __attribute__((vector_size(32)));
  // x = 2^e m with m from sqrt(1/2) to sqrt(2); the offset makes the mantissa wrap at sqrt(2) instead of 2.
  constexpr unsigned long long one = 0x3ff0000000000000, sqrt_half = 0x3fe6a09e667f3bcd,
                               mantissa = 0xfffffffffffff;
  const Bits shifted = reinterpret_cast<Bits>(x) + (one - sqrt_half);
  const Lanes m = reinterpret_cast<Lanes>((shifted & mantissa) + sqrt_half);
  // An integer below 2^52 in the mantissa of 2^52 is that integer plus 2^52.
  constexpr unsigned long long two_to_52 = 0x4330000000000000;
  const Lanes e = reinterpret_cast<Lanes>((shifted >> 52) | two_to_52) - (4503599627370496. + 1023.);

  // log m = 2 artanh s, |s| < .172.
  const Lanes s = (m - 1.) / (m + 1.);
  const Lanes q = s * s;
  Lanes series;
  sum_odd_series<17>(q, series);
  constexpr double log_2 = 0.6931471805599453;
  x = e * log_2 + 2. * s * (1. + q * series);
}

/// The angle in radians between the vector (x, y) and the first axis, with a relative error of about 1e-15 up
/// to 90 degrees. Pre-condition: y > 0 and r is the length of the vector.
HOOKE_INLINE void take_angle(const Lanes& x, const Lanes& y, const Lanes& r, Lanes& angle) {
  Lanes t = y / (r + x);  // tan of half the angle, then of a quarter, then of an eighth
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
