#include "hooke/filter/thin_plate_spline.h"

#include <fmt/format.h>
#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <algorithm>

#include "hooke/core/error.h"

namespace hooke {
namespace {

// Memory layout: coordinates x[n], y[n], z[n]; coefficients a[n], then those of the polynomial. n is the
// number of centres rounded up to whole groups of lanes; the padding has coefficient 0. Sums run over whole
// groups, so that their order does not depend on where the data lie.

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

/// Adds the radial part of [30] and [35]; n is a multiple of lane_count.
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
  const std::size_t count = centres.cols(), stride = padded_to_lanes(count);
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

namespace {

constexpr std::size_t polynomial_size = monomial_count(2);

constexpr double min_pivot_ratio = 1e-7;  // on the Cholesky diagonal; below, the coefficients are noise

using Monomials = Eigen::Matrix<double, polynomial_size, 1>;
Monomials monomials(double x, double y, double z) {
  return Monomials{1, x, y, z, x * x, y * y, z * z, x * y, y * z, z * x};
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

/// A := H A H for the reflector H = I - tau v v^T, lower triangle only.
void reflect_both_sides(Eigen::MatrixXd& A, const Eigen::VectorXd& v, double tau, Eigen::VectorXd& w) {
  w.noalias() = tau * (A.selfadjointView<Eigen::Lower>() * v);
  w -= (.5 * tau * v.dot(w)) * v;
  A.selfadjointView<Eigen::Lower>().rankUpdate(v, w, -1);
}

bool is_independent(const Eigen::MatrixXd& R, Eigen::Index m) {
  for (Eigen::Index k = 0; k < m; ++k)
    if (!(std::abs(R(k, k)) > min_independent_part(k) * R.col(k).head(k + 1).norm())) return false;
  return true;
}

}  // namespace

std::size_t spline_fit_bytes(std::size_t centres) {
  return sizeof(double) * (centres * centres + 24 * centres);
}

std::optional<SplineCoefficients> fit_spline(const Eigen::Ref<const Mat3X>& centres,
                                             const Eigen::Ref<const Eigen::VectorXd>& values, Kernel kernel,
                                             SplineDegree degree, SplineWorkspace& workspace) {
  const Eigen::Index n = centres.cols();
  const Eigen::Index m = monomial_count(degree);
  if (n < m) return std::nullopt;

  // P = Q R; the coefficients a are orthogonal to the polynomials, so a = Q [0; z].
  auto& P = workspace.polynomials;
  P.resize(n, m);
  for (Eigen::Index i = 0; i < n; ++i)
    P.row(i) = monomials(centres(0, i), centres(1, i), centres(2, i)).head(m).transpose();
  const Eigen::HouseholderQR<Eigen::Ref<Eigen::MatrixXd>> qr(P);
  if (!is_independent(P, m)) return std::nullopt;

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
    if (llt.info() != Eigen::Success) return std::nullopt;
    const auto pivots = A22.diagonal();
    if (!(pivots.minCoeff() > min_pivot_ratio * pivots.maxCoeff())) return std::nullopt;
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
  if (!a.allFinite() || !d.head(m).allFinite()) return std::nullopt;

  SplineCoefficients spline{.radial = {a.begin(), a.end()}};
  std::copy_n(d.begin(), m, spline.polynomial.begin());
  return spline;
}

std::optional<ThinPlateSpline> ThinPlateSpline::fit(const Mat3X& centres, const Eigen::VectorXd& values,
                                                    Kernel kernel, SplineDegree degree,
                                                    std::size_t memory_limit_bytes) {
  ThinPlateSpline spline;
  spline.kernel_ = kernel;
  spline.centres_ = centres.cols();
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

  SplineWorkspace workspace;
  const auto fitted = fit_spline(local, values / spline.scale_, kernel, degree, workspace);
  if (!fitted) return std::nullopt;
  spline.coordinates_.resize(StoredSpline<double>::coordinates_size(spline.centres_));
  spline.coefficients_.resize(StoredSpline<double>::coefficients_size(spline.centres_));
  store_spline(local, *fitted, spline.coordinates_.data(), spline.coefficients_.data());
  return spline;
}

FieldSample ThinPlateSpline::operator()(const Vec3& x) const {
  const StoredSpline<double> stored{coordinates_.data(), coefficients_.data(), centres_};
  FieldSample s = stored(kernel_, (x - origin_) / scale_);
  s.value *= scale_;
  return s;
}

}  // namespace hooke
