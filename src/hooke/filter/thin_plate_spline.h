// Thin-plate splines in space: a radial part and a polynomial, fitted to values at centres, and their
// evaluation in SIMD lanes. "Hooke's Optimization for 3D triangular mesh", sections 3.3 and 4.4, equations
// [27]-[35]. The system is solved on the null space of the polynomials, where the kernel matrix is positive
// definite (H. Wendland, "Scattered Data Approximation", 2005, chapter 8).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "hooke/core/simd.h"
#include "hooke/core/types.h"
#include "hooke/filter/filter.h"

namespace hooke {

/// Polynomial part: 1 affine [29], 2 quadratic.
using SplineDegree = int;

/// Number of monomials of a degree: 4 or 10.
constexpr int monomial_count(SplineDegree degree) {
  return degree == 2 ? 10 : 4;
}

/// Minimum part of a monomial independent of those before it, at the centres, for a spline with a part of
/// that degree. The quadratic one is not determined where vertices lie in two rows, as on the side of a
/// cylinder: there the product of the distances from both rows, which is large between them, would fit their
/// rounding.
constexpr double min_independent_part(std::size_t monomial) {
  return monomial < monomial_count(1) ? 1e-8 : 1e-3;
}

/// Scratch memory of fit_spline, reused from fit to fit.
struct SplineWorkspace {
  Eigen::MatrixXd kernel_matrix;
  Eigen::MatrixXd polynomials;
  Eigen::VectorXd right_side;
};

/// Coefficients of a spline: of the kernel at each centre, and of the monomials 1, x, y, z, x x, y y, z z, x
/// y, y z, z x.
struct SplineCoefficients {
  std::vector<double> radial;
  std::array<double, monomial_count(2)> polynomial{};
};

/// Fits a spline to values at centres [31]. The centres should be of size 1 about the origin, for
/// conditioning. Returns nothing if they do not determine the spline: too few for the polynomials, on or
/// next to an algebraic surface of that degree (see min_independent_part()), or (nearly) coincident.
std::optional<SplineCoefficients> fit_spline(const Eigen::Ref<const Mat3X>& centres,
                                             const Eigen::Ref<const Eigen::VectorXd>& values, Kernel kernel,
                                             SplineDegree degree, SplineWorkspace& workspace);

/// Bytes needed to fit a spline of this many centres: mostly the kernel matrix, factorized in place.
std::size_t spline_fit_bytes(std::size_t centres);

/// A single spline in any coordinates; it is fitted in coordinates centred and scaled to size 1.
class ThinPlateSpline {
 public:
  /// Returns nothing if the centres do not determine the spline (see fit_spline()).
  /// Throws LimitError, naming the bytes, if the fit would take more than `memory_limit_bytes`.
  static std::optional<ThinPlateSpline> fit(const Mat3X& centres, const Eigen::VectorXd& values,
                                            Kernel kernel, SplineDegree degree,
                                            std::size_t memory_limit_bytes = SIZE_MAX);

  /// Value [30] and gradient [35] at x.
  FieldSample operator()(const Vec3& x) const;

  std::size_t memory_bytes() const {
    return sizeof(double) * (coordinates_.capacity() + coefficients_.capacity());
  }

 private:
  Kernel kernel_ = Kernel::r3;
  Vec3 origin_ = Vec3::Zero();
  double scale_ = 1;
  std::size_t centres_ = 0;
  std::vector<double> coordinates_, coefficients_;
};

// The radial kernels, one value per lane.

/// The kernel [27] and its derivative over r, at r2 = r^2.
struct KernelSample {
  Lanes value, slope_over_r;
};

HOOKE_INLINE void sample_kernel(Kernel kernel, const Lanes& r2, KernelSample& sample) {
  if (kernel == Kernel::r2logr) {
    constexpr double smallest = std::numeric_limits<double>::min();  // r^2 log r is 0 at r = 0
    Lanes log_r2 = r2 > smallest ? r2 : Lanes{} + smallest;
    take_log(log_r2);
    sample.value = .5 * r2 * log_r2;
    sample.slope_over_r = log_r2 + 1.;
  } else {
    Lanes r = r2;
    take_sqrt(r);
    sample.value = r2 * r;
    sample.slope_over_r = 3. * r;
  }
}

// Splines stored for repeated evaluation.

/// A centre's coordinate in units of 2^-30: half the memory of a double, and as accurate for centres of size
/// 1 about the origin.
using SnappedCoordinate = std::int32_t;

/// The point nearest to `point` that snapped coordinates represent exactly. They range from -2 to 2.
Vec3 snapped(const Vec3& point);

/// A stored spline, which refers to memory held elsewhere. `Coordinate`: double or SnappedCoordinate.
template <typename Coordinate>
struct StoredSpline {
  const Coordinate* coordinates = nullptr;  // of the centres: coordinates_size() numbers
  const double* coefficients = nullptr;     // coefficients_size() numbers
  std::size_t centres = 0;

  /// Numbers that a spline of this many centres takes.
  static std::size_t coordinates_size(std::size_t centres);
  static std::size_t coefficients_size(std::size_t centres);

  /// Value [30] and gradient [35] at x.
  FieldSample operator()(Kernel kernel, const Vec3& x) const;
};

/// Stores a spline in the given memory, which must outlive the result. Pre-condition: the coordinates
/// represent the centres exactly.
template <typename Coordinate>
StoredSpline<Coordinate> store_spline(const Eigen::Ref<const Mat3X>& centres,
                                      const SplineCoefficients& spline, Coordinate* coordinates,
                                      double* coefficients);

extern template struct StoredSpline<double>;
extern template struct StoredSpline<SnappedCoordinate>;

}  // namespace hooke
