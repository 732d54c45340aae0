#include "hooke/thin_plate_spline.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>

#include "hooke/error.h"
#include "hooke/spline_kernel.h"

namespace hooke {
namespace {

// Storage: x[n], y[n], z[n], a[n], then ten polynomial coefficients; n is rounded up to whole groups of
// lanes, and the extra centres have coefficient 0. Fixed groups, so that sums run in the same order wherever
// the data lie.
constexpr std::size_t polynomial_size = 10;

constexpr double least_column_ratio = 1e-8;  // of a polynomial's part that the ones before it do not explain
constexpr double least_pivot_ratio = 1e-7;   // of the Cholesky diagonal: beyond, coefficients are noise

std::size_t padded(std::size_t centres) {
  return padded_to_lanes(centres);
}

using Monomials = Eigen::Matrix<double, polynomial_size, 1>;
Monomials monomials(double x, double y, double z) {
  return Monomials{1, x, y, z, x * x, y * y, z * z, x * y, y * z, z * x};
}

FieldSample evaluate_polynomial(const double* c, const Vec3& p) {
  const double x = p[0], y = p[1], z = p[2];
  FieldSample s;
  s.value = c[0] + x * (c[1] + x * c[4] + y * c[7]) + y * (c[2] + y * c[5] + z * c[8]) +
            z * (c[3] + z * c[6] + x * c[9]);
  s.gradient = {c[1] + 2 * x * c[4] + y * c[7] + z * c[9], c[2] + 2 * y * c[5] + x * c[7] + z * c[8],
                c[3] + 2 * z * c[6] + y * c[8] + x * c[9]};
  return s;
}

/// Lower triangle of the kernel matrix. [32]
HOOKE_SIMD void fill_kernel_matrix(const Eigen::Ref<const Mat3X>& centres, Kernel kernel,
                                   Eigen::MatrixXd& A) {
  const Eigen::Index n = centres.cols();
  A.resize(n, n);
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index i = j; i < n; i += lane_count) {
      const Eigen::Index count = std::min<Eigen::Index>(lane_count, n - i);
      Lanes r2 = {};
      for (Eigen::Index k = 0; k < count; ++k) r2[k] = (centres.col(i + k) - centres.col(j)).squaredNorm();
      KernelSample phi;
      sample_kernel(kernel, r2, phi);
      for (Eigen::Index k = 0; k < count; ++k) A(i + k, j) = phi.value[k];
    }
}

/// Adds the radial part of [30] and [35]; n whole groups of lanes.
HOOKE_SIMD void add_radial_part(const double* storage, std::size_t n, Kernel kernel, const Vec3& p,
                                FieldSample& sample) {
  Lanes value = {}, gx = {}, gy = {}, gz = {};
  for (std::size_t i = 0; i < n; i += lane_count) {
    Lanes x, y, z, a;
    load(storage + i, x);
    load(storage + n + i, y);
    load(storage + 2 * n + i, z);
    load(storage + 3 * n + i, a);
    const Lanes dx = p[0] - x, dy = p[1] - y, dz = p[2] - z;
    KernelSample phi;
    sample_kernel(kernel, dx * dx + dy * dy + dz * dz, phi);
    const Lanes slope = a * phi.slope_over_r;
    value += a * phi.value;
    gx += slope * dx;
    gy += slope * dy;
    gz += slope * dz;
  }
  sample.value += sum_of(value);
  sample.gradient += Vec3(sum_of(gx), sum_of(gy), sum_of(gz));
}

/// A := H A H for the reflector H = I - tau v v^T, lower triangle only.
void reflect_both_sides(Eigen::MatrixXd& A, const Eigen::VectorXd& v, double tau, Eigen::VectorXd& w) {
  w.noalias() = tau * (A.selfadjointView<Eigen::Lower>() * v);
  w -= (.5 * tau * v.dot(w)) * v;
  A.selfadjointView<Eigen::Lower>().rankUpdate(v, w, -1);
}

bool is_independent(const Eigen::MatrixXd& R, Eigen::Index m) {
  for (Eigen::Index k = 0; k < m; ++k)
    if (!(std::abs(R(k, k)) > least_column_ratio * R.col(k).head(k + 1).norm())) return false;
  return true;
}

}  // namespace

std::size_t spline_storage_size(std::size_t centres) {
  return 4 * padded(centres) + polynomial_size;
}

std::size_t spline_fit_bytes(std::size_t centres) {
  return sizeof(double) * (centres * centres + 24 * centres);
}

bool fit_spline(const Eigen::Ref<const Mat3X>& centres, const Eigen::Ref<const Eigen::VectorXd>& values,
                Kernel kernel, SplineDegree degree, SplineWorkspace& workspace, double* storage) {
  const Eigen::Index n = centres.cols();
  const Eigen::Index m = monomial_count(degree);
  if (n < m) return false;

  // P = Q R; the coefficients a are orthogonal to the polynomials, so a = Q [0; z].
  auto& P = workspace.polynomials;
  P.resize(n, m);
  for (Eigen::Index i = 0; i < n; ++i)
    P.row(i) = monomials(centres(0, i), centres(1, i), centres(2, i)).head(m).transpose();
  const Eigen::HouseholderQR<Eigen::Ref<Eigen::MatrixXd>> qr(P);
  if (!is_independent(P, m)) return false;

  auto& A = workspace.kernel_matrix;
  auto& d = workspace.right_side;
  fill_kernel_matrix(centres, kernel, A);
  d = values;
  Eigen::VectorXd v(n), w(n);
  for (Eigen::Index k = 0; k < m; ++k) {
    v.head(k).setZero();
    v[k] = 1;
    v.tail(n - k - 1) = P.col(k).tail(n - k - 1);
    const double tau = qr.hCoeffs()[k];
    reflect_both_sides(A, v, tau, w);
    d -= tau * v.dot(d) * v;
  }

  // [31] in these coordinates: A22 z = d2, then R c = d1 - A12 z.
  Eigen::VectorXd a = Eigen::VectorXd::Zero(n);
  if (n > m) {
    Eigen::Ref<Eigen::MatrixXd> A22 = A.bottomRightCorner(n - m, n - m);
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(A22);
    if (llt.info() != Eigen::Success) return false;
    const auto pivots = A22.diagonal();
    if (!(pivots.minCoeff() > least_pivot_ratio * pivots.maxCoeff())) return false;
    a.tail(n - m) = llt.solve(d.tail(n - m));
    d.head(m).noalias() -= A.bottomLeftCorner(n - m, m).transpose() * a.tail(n - m);
  }
  P.topRows(m).triangularView<Eigen::Upper>().solveInPlace(d.head(m));
  for (Eigen::Index k = m - 1; k >= 0; --k) {
    const auto essential = P.col(k).tail(n - k - 1);
    const double s = qr.hCoeffs()[k] * (a[k] + essential.dot(a.tail(n - k - 1)));
    a[k] -= s;
    a.tail(n - k - 1) -= s * essential;
  }
  if (!a.allFinite() || !d.head(m).allFinite()) return false;

  store_spline(centres, {a.data(), static_cast<std::size_t>(n)}, {d.data(), static_cast<std::size_t>(m)},
               storage);
  return true;
}

void store_spline(const Eigen::Ref<const Mat3X>& centres, std::span<const double> radial,
                  std::span<const double> polynomial, double* storage) {
  const std::size_t stride = padded(radial.size());
  std::fill_n(storage, 4 * stride + polynomial_size, 0.);
  for (int k = 0; k < 3; ++k)
    Eigen::VectorXd::Map(storage + static_cast<std::size_t>(k) * stride, centres.cols()) = centres.row(k);
  std::ranges::copy(radial, storage + 3 * stride);
  std::ranges::copy(polynomial, storage + 4 * stride);
}

FieldSample evaluate_spline(const double* storage, std::size_t centres, Kernel kernel, const Vec3& x) {
  const std::size_t n = padded(centres);
  FieldSample sample = evaluate_polynomial(storage + 4 * n, x);
  add_radial_part(storage, n, kernel, x, sample);
  return sample;
}

std::optional<ThinPlateSpline> ThinPlateSpline::fit(const Mat3X& centres, const Eigen::VectorXd& values,
                                                    Kernel kernel, SplineDegree degree,
                                                    std::size_t memory_limit_bytes) {
  ThinPlateSpline spline;
  spline.kernel_ = kernel;
  spline.centres_ = static_cast<std::size_t>(centres.cols());
  const std::size_t bytes = spline_fit_bytes(spline.centres_);
  if (bytes > memory_limit_bytes)
    throw LimitError(
        fmt::format("a thin-plate spline of {} centres takes {} bytes; {} bytes are allowed; "
                    "use the local filter, or more memory",
                    spline.centres_, bytes, memory_limit_bytes));
  if (spline.centres_ == 0) return std::nullopt;
  spline.origin_ = centres.rowwise().mean();
  Mat3X local = centres.colwise() - spline.origin_;
  spline.scale_ = std::sqrt(local.colwise().squaredNorm().maxCoeff());
  if (!(spline.scale_ > 0)) return std::nullopt;
  local /= spline.scale_;

  spline.storage_.resize(spline_storage_size(spline.centres_));
  SplineWorkspace workspace;
  if (!fit_spline(local, values / spline.scale_, kernel, degree, workspace, spline.storage_.data()))
    return std::nullopt;
  return spline;
}

FieldSample ThinPlateSpline::operator()(const Vec3& x) const {
  FieldSample s = evaluate_spline(storage_.data(), centres_, kernel_, (x - origin_) / scale_);
  s.value *= scale_;
  return s;
}

}  // namespace hooke
