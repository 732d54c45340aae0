// Four numbers at a time, for the kernels in which the time goes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

// Compiled twice, and the processor picks when the program starts. Without fused multiply-add, so that both
// give the same results.
#if defined(__x86_64__) && defined(__GNUC__)
#define HOOKE_SIMD [[gnu::target_clones("avx2", "default")]]
#else
#define HOOKE_SIMD
#endif
// Lanes have no calling convention of their own: what takes them is inlined, and takes them by reference.
#define HOOKE_INLINE [[gnu::always_inline]] inline

namespace hooke {

/// Four doubles; + - * / and comparisons act on each. One register where there is AVX2, two where there is
/// not: the results are the same.
using Lanes = double __attribute__((vector_size(32)));
using LaneMask = long long __attribute__((vector_size(32)));  // of a comparison: -1 or 0 in each
constexpr std::size_t lane_count = 4;

/// The least multiple of the lanes that holds so many.
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

/// Three coordinates, lane by lane.
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

}  // namespace hooke
