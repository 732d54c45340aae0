// Thin-plate splines as they are kept to be evaluated again and again.
#pragma once

#include <cstdint>

#include "hooke/filter/thin_plate_spline.h"

namespace hooke {

/// A centre's coordinate in parts of 2^-30: half the memory of a double, and as good for centres of size 1
/// about the origin.
using SnappedCoordinate = std::int32_t;

/// The place nearest to a point that snapped coordinates tell exactly. They reach from -2 to 2.
Vec3 snapped(const Vec3& point);

/// Where a spline is kept. `Coordinate`: double or SnappedCoordinate.
template <typename Coordinate>
struct StoredSpline {
  const Coordinate* coordinates = nullptr;  // of the centres: coordinates_size() of them
  const double* coefficients = nullptr;     // coefficients_size()
  std::size_t centres = 0;

  static std::size_t coordinates_size(std::size_t centres);
  static std::size_t coefficients_size(std::size_t centres);

  /// Value [30] and gradient [35] at x.
  FieldSample operator()(Kernel kernel, const Vec3& x) const;
};

/// Keeps a spline in this memory. Pre-condition: the coordinates tell the centres exactly.
template <typename Coordinate>
StoredSpline<Coordinate> store_spline(const Eigen::Ref<const Mat3X>& centres,
                                      const SplineCoefficients& spline, Coordinate* coordinates,
                                      double* coefficients);

extern template struct StoredSpline<double>;
extern template struct StoredSpline<SnappedCoordinate>;

}  // namespace hooke
