#include "hooke/filter/stored_spline.h"

#include <algorithm>

#include "hooke/filter/spline_kernel.h"

namespace hooke {
namespace {

// Coordinates: x[n], y[n], z[n]. Coefficients: a[n], then the polynomial's. n is rounded up to whole groups
// of lanes, and the extra centres have coefficient 0. Fixed groups, so that sums run in the same order
// wherever the data lie.

template <typename Coordinate>
constexpr double unit = 1;
template <>
constexpr double unit<SnappedCoordinate> = 0x1p-30;

FieldSample evaluate_polynomial(const double* c, const Vec3& p) {
  const double x = p[0], y = p[1], z = p[2];
  FieldSample s;
  s.value = c[0] + x * (c[1] + x * c[4] + y * c[7]) + y * (c[2] + y * c[5] + z * c[8]) +
            z * (c[3] + z * c[6] + x * c[9]);
  s.gradient = {c[1] + 2 * x * c[4] + y * c[7] + z * c[9], c[2] + 2 * y * c[5] + x * c[7] + z * c[8],
                c[3] + 2 * z * c[6] + y * c[8] + x * c[9]};
  return s;
}

/// Adds the radial part of [30] and [35]; n whole groups of lanes.
template <typename Coordinate>
HOOKE_INLINE void sum_radial_part(const Coordinate* centres, const double* a, std::size_t n, Kernel kernel,
                                  const Vec3& p, FieldSample& sample) {
  constexpr double one = unit<Coordinate>;
  const double px = p[0] / one, py = p[1] / one, pz = p[2] / one;
  Lanes value = {}, gx = {}, gy = {}, gz = {};
  for (std::size_t i = 0; i < n; i += lane_count) {
    Lanes x, y, z, weight;
    load(centres + i, x);
    load(centres + n + i, y);
    load(centres + 2 * n + i, z);
    load(a + i, weight);
    const Lanes dx = px - x, dy = py - y, dz = pz - z;
    KernelSample phi;
    sample_kernel(kernel, one * one * (dx * dx + dy * dy + dz * dz), phi);
    const Lanes slope = weight * phi.slope_over_r;
    value += weight * phi.value;
    gx += slope * dx;
    gy += slope * dy;
    gz += slope * dz;
  }
  sample.value += sum_of(value);
  sample.gradient += one * Vec3(sum_of(gx), sum_of(gy), sum_of(gz));
}

HOOKE_SIMD void add_radial_part(const double* centres, const double* a, std::size_t n, Kernel kernel,
                                const Vec3& p, FieldSample& sample) {
  sum_radial_part(centres, a, n, kernel, p, sample);
}
HOOKE_SIMD void add_radial_part(const SnappedCoordinate* centres, const double* a, std::size_t n,
                                Kernel kernel, const Vec3& p, FieldSample& sample) {
  sum_radial_part(centres, a, n, kernel, p, sample);
}

}  // namespace

Vec3 snapped(const Vec3& point) {
  constexpr double one = unit<SnappedCoordinate>, most = 0x7fffffff * one;
  constexpr double shift = 0x1.8p52 * one;  // doubles of this size have no digits below the unit
  return ((point.array() + shift) - shift).max(-most).min(most);
}

template <typename Coordinate>
std::size_t StoredSpline<Coordinate>::coordinates_size(std::size_t centres) {
  return 3 * padded_to_lanes(centres);
}

template <typename Coordinate>
std::size_t StoredSpline<Coordinate>::coefficients_size(std::size_t centres) {
  return padded_to_lanes(centres) + monomial_count(2);
}

template <typename Coordinate>
FieldSample StoredSpline<Coordinate>::operator()(Kernel kernel, const Vec3& x) const {
  const std::size_t n = padded_to_lanes(centres);
  FieldSample sample = evaluate_polynomial(coefficients + n, x);
  add_radial_part(coordinates, coefficients, n, kernel, x, sample);
  return sample;
}

template <typename Coordinate>
StoredSpline<Coordinate> store_spline(const Eigen::Ref<const Mat3X>& centres,
                                      const SplineCoefficients& spline, Coordinate* coordinates,
                                      double* coefficients) {
  const auto count = static_cast<std::size_t>(centres.cols()), stride = padded_to_lanes(count);
  const StoredSpline<Coordinate> stored{coordinates, coefficients, count};
  std::fill_n(coordinates, stored.coordinates_size(count), Coordinate{0});
  std::fill_n(coefficients, stored.coefficients_size(count), 0.);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      coordinates[k * stride + i] = static_cast<Coordinate>(
          centres(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i)) / unit<Coordinate>);
  std::ranges::copy(spline.radial, coefficients);
  std::ranges::copy(spline.polynomial, coefficients + stride);
  return stored;
}

template struct StoredSpline<double>;
template struct StoredSpline<SnappedCoordinate>;
template StoredSpline<double> store_spline(const Eigen::Ref<const Mat3X>&, const SplineCoefficients&, double*,
                                           double*);
template StoredSpline<SnappedCoordinate> store_spline(const Eigen::Ref<const Mat3X>&,
                                                      const SplineCoefficients&, SnappedCoordinate*, double*);

}  // namespace hooke
