// Thin-plate splines in space: a radial part and a polynomial, fitted to values at centres. Points only.
// "Hooke's Optimization for 3D triangular mesh", sections 3.3 and 4.4, equations [27]-[35]. The system is
// solved on the null space of the polynomials, where the kernel matrix is positive definite (H. Wendland,
// "Scattered Data Approximation", 2005, chapter 8).
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "hooke/types.h"

namespace hooke {

/// r2logr is the paper's [27]. Both are conditionally positive definite of order 2: an affine part is the
/// least.
enum class Kernel { r2logr, r3 };

/// Polynomial part: 1 affine [29], 2 quadratic.
using SplineDegree = int;

/// Number of monomials of a degree: 4 or 10.
constexpr int monomial_count(SplineDegree degree) {
  return degree == 2 ? 10 : 4;
}

/// Scratch memory of fit_spline, reused from fit to fit.
struct SplineWorkspace {
  Eigen::MatrixXd kernel_matrix;
  Eigen::MatrixXd polynomials;
  Eigen::VectorXd right_side;
};

/// Number of doubles in which fit_spline stores a spline of so many centres.
std::size_t spline_storage_size(std::size_t centres);

/// Fits a spline to values at centres [31] and writes it to `storage`. The centres should be of size 1 about
/// the origin, for conditioning. Returns false, with `storage` undefined, when the centres do not determine
/// it: too few for the polynomials, on a surface of that degree, or (nearly) coincident. Pre-condition:
/// storage holds spline_storage_size(centres.cols()) doubles.
bool fit_spline(const Eigen::Ref<const Mat3X>& centres, const Eigen::Ref<const Eigen::VectorXd>& values,
                Kernel kernel, SplineDegree degree, SplineWorkspace& workspace, double* storage);

/// Writes a spline with these coefficients of the kernel at the centres and of the monomials, which are 1, x,
/// y, z, x x, y y, z z, x y, y z, z x. Pre-condition as for fit_spline.
void store_spline(const Eigen::Ref<const Mat3X>& centres, std::span<const double> radial,
                  std::span<const double> polynomial, double* storage);

/// Value [30] and gradient [35] at x of a spline stored for so many centres.
FieldSample evaluate_spline(const double* storage, std::size_t centres, Kernel kernel, const Vec3& x);

/// Bytes needed while a spline of so many centres is fitted: the kernel matrix, worked on in place.
std::size_t spline_fit_bytes(std::size_t centres);

/// One spline on its own, in any coordinates: it is fitted in coordinates centred and scaled to size 1.
class ThinPlateSpline {
 public:
  /// Nothing when the centres do not determine the spline (see fit_spline).
  /// Throws LimitError, naming the bytes, when the fit would take more than `memory_limit_bytes`.
  static std::optional<ThinPlateSpline> fit(const Mat3X& centres, const Eigen::VectorXd& values,
                                            Kernel kernel, SplineDegree degree,
                                            std::size_t memory_limit_bytes = SIZE_MAX);

  FieldSample operator()(const Vec3& x) const;

  std::size_t memory_bytes() const { return sizeof(double) * storage_.capacity(); }

 private:
  Kernel kernel_ = Kernel::r3;
  std::size_t centres_ = 0;
  Vec3 origin_ = Vec3::Zero();
  double scale_ = 1;
  std::vector<double> storage_;
};

}  // namespace hooke
