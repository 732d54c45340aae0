#include "hooke/filter/spline_batch.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hooke/core/simd.h"
#include "hooke/filter/thin_plate_spline.h"

namespace hooke {
namespace {

// The equations of four splines with a quadratic part, one per lane, and their solution.

constexpr std::size_t quadratic_monomials = monomial_count(2);

/// Start of row i of a packed lower triangle.
constexpr std::size_t row_of(std::size_t i) {
  return i * (i + 1) / 2;
}

/// An array of lanes.
class LaneArray {
 public:
  explicit LaneArray(double* data) : data_(data) {}
  HOOKE_INLINE void get(std::size_t i, Lanes& x) const { load(data_ + lane_count * i, x); }
  HOOKE_INLINE void set(std::size_t i, const Lanes& x) const { store(x, data_ + lane_count * i); }
  HOOKE_INLINE LaneArray from(std::size_t i) const { return LaneArray(data_ + lane_count * i); }

 private:
  double* data_;
};

/// The linear system of a group with `rows` centres. Lanes with fewer centres are padded: their extra rows
/// hold only a 1 on the diagonal.
struct System {
  std::size_t rows;
  LaneArray centres, present;
  LaneArray A;  // lower triangle, row by row
  LaneArray P;  // column by column; after the factorization R, and below it the reflectors
  LaneArray d, a, v, w;
  Lanes tau[quadratic_monomials];
  LaneMask solved;
};

/// Computes the coefficients of the centres in `a`, those of the polynomials in the first rows of `d`, and in
/// `solved` which lanes have a solution. [31], [32]
void solve_system(System& system, Kernel kernel, double min_distance);

/// Adds the dot product of two arrays to the sum.
HOOKE_INLINE void add_products(const LaneArray& a, const LaneArray& b, std::size_t count, Lanes& sum) {
  Lanes even = {}, odd = {}, x, y;  // two sums shorten the dependency chain
  for (std::size_t i = 0; i < count; ++i) {
    a.get(i, x);
    b.get(i, y);
    (i % 2 == 0 ? even : odd) += x * y;
  }
  sum += even + odd;
}

/// a -= factor * b
HOOKE_INLINE void subtract_scaled(const Lanes& factor, const LaneArray& b, std::size_t count,
                                  const LaneArray& a) {
  Lanes x, y;
  for (std::size_t i = 0; i < count; ++i) {
    a.get(i, x);
    b.get(i, y);
    a.set(i, x - factor * y);
  }
}

HOOKE_INLINE void fill_polynomials(System& s) {
  for (std::size_t i = 0; i < s.rows; ++i) {
    Lanes x, y, z, p;
    s.centres.get(3 * i, x);
    s.centres.get(3 * i + 1, y);
    s.centres.get(3 * i + 2, z);
    s.present.get(i, p);
    const Lanes row[quadratic_monomials] = {p, x, y, z, x * x, y * y, z * z, x * y, y * z, z * x};
    for (std::size_t k = 0; k < quadratic_monomials; ++k) s.P.set(k * s.rows + i, row[k]);
  }
}

/// P = Q R by Householder reflectors I - tau v v^T.
HOOKE_INLINE void factor_polynomials(System& s) {
  const Lanes zero = {}, one = zero + 1.;
  for (std::size_t k = 0; k < quadratic_monomials; ++k) {
    const LaneArray column = s.P.from(k * s.rows), below = column.from(k + 1);
    const std::size_t rest = s.rows - k - 1;
    Lanes tail = zero, head, explained = zero;
    add_products(below, below, rest, tail);
    add_products(column, column, k, explained);
    column.get(k, head);
    const LaneMask reflects = tail > 0.;
    Lanes beta = head * head + tail;
    take_sqrt(beta);
    beta = head < 0. ? beta : -beta;
    beta = reflects ? beta : head;
    s.tau[k] = reflects ? (beta - head) / beta : zero;
    const Lanes scale = one / (reflects ? head - beta : one);
    column.set(k, beta);
    Lanes x;
    for (std::size_t i = 0; i < rest; ++i) {
      below.get(i, x);
      below.set(i, x * scale);
    }
    const double least = min_independent_part(k);
    s.solved &= beta * beta > least * least * (explained + beta * beta);
    for (std::size_t j = k + 1; j < quadratic_monomials; ++j) {
      const LaneArray other = s.P.from(j * s.rows);
      Lanes along;
      other.get(k, along);
      add_products(below, other.from(k + 1), rest, along);
      along *= s.tau[k];
      other.get(k, x);
      other.set(k, x - along);
      subtract_scaled(along, below, rest, other.from(k + 1));
    }
  }
}

/// Lower triangle of the kernel matrix. [32]
HOOKE_INLINE void fill_kernel_matrix(Kernel kernel, double min_distance, System& s) {
  LaneMask near = {};
  for (std::size_t i = 0; i < s.rows; ++i) {
    const LaneArray row = s.A.from(row_of(i));
    Lanes x, y, z, p;
    s.centres.get(3 * i, x);
    s.centres.get(3 * i + 1, y);
    s.centres.get(3 * i + 2, z);
    s.present.get(i, p);
    for (std::size_t j = 0; j < i; ++j) {
      Lanes dx, dy, dz, q;
      s.centres.get(3 * j, dx);
      s.centres.get(3 * j + 1, dy);
      s.centres.get(3 * j + 2, dz);
      s.present.get(j, q);
      dx -= x;
      dy -= y;
      dz -= z;
      q *= p;
      const Lanes r2 = dx * dx + dy * dy + dz * dz;
      KernelSample phi;
      sample_kernel(kernel, r2, phi);
      near |= (r2 < min_distance * min_distance) & (q > 0.);
      row.set(j, phi.value * q);
    }
    row.set(i, 1. - p);
  }
  s.solved &= ~near;
}

/// A := H A H and d := H d for the reflector k.
HOOKE_INLINE void reflect(System& s, std::size_t k) {
  const Lanes zero = {};
  for (std::size_t i = 0; i < s.rows; ++i) {
    s.v.set(i, zero);
    s.w.set(i, zero);
  }
  Lanes x, y, vi, wi, aij;
  s.v.set(k, zero + 1.);
  for (std::size_t i = k + 1; i < s.rows; ++i) {
    s.P.get(k * s.rows + i, x);
    s.v.set(i, x);
  }
  for (std::size_t i = k; i < s.rows; ++i) {  // w = A v
    const LaneArray row = s.A.from(row_of(i));
    s.v.get(i, vi);
    for (std::size_t j = 0; j < k; ++j) {
      row.get(j, aij);
      s.w.get(j, x);
      s.w.set(j, x + aij * vi);
    }
    Lanes even = zero, odd = zero;
    for (std::size_t j = k; j < i; ++j) {
      row.get(j, aij);
      s.w.get(j, x);
      s.v.get(j, y);
      s.w.set(j, x + aij * vi);
      ((j - k) % 2 == 0 ? even : odd) += aij * y;
    }
    row.get(i, aij);
    s.w.get(i, x);
    s.w.set(i, x + (aij * vi + (even + odd)));
  }
  Lanes vw = zero, vd = zero;
  add_products(s.v.from(k), s.w.from(k), s.rows - k, vw);
  add_products(s.v.from(k), s.d.from(k), s.rows - k, vd);
  const Lanes tau = s.tau[k], half = .5 * tau * tau * vw;
  for (std::size_t i = 0; i < s.rows; ++i) {
    s.w.get(i, x);
    s.v.get(i, y);
    s.w.set(i, tau * x - half * y);
  }
  subtract_scaled(tau * vd, s.v.from(k), s.rows - k, s.d.from(k));
  for (std::size_t i = k; i < s.rows; ++i) {  // A -= v w^T + w v^T
    const LaneArray row = s.A.from(row_of(i));
    s.v.get(i, vi);
    s.w.get(i, wi);
    subtract_scaled(vi, s.w, k, row);
    for (std::size_t j = k; j <= i; ++j) {
      row.get(j, aij);
      s.w.get(j, x);
      s.v.get(j, y);
      row.set(j, aij - (vi * x + wi * y));
    }
  }
}

/// In-place Cholesky factorization of A restricted to the complement of the polynomials.
HOOKE_INLINE void factor_kernel_matrix(System& s) {
  constexpr double min_pivot_ratio = 1e-7;  // on the diagonal; below, the coefficients are noise
  Lanes smallest = Lanes{} + std::numeric_limits<double>::infinity(), largest = {};
  for (std::size_t k = quadratic_monomials; k < s.rows; ++k) {
    Lanes pivot, p, x, y;
    s.A.get(row_of(k) + k, pivot);
    s.present.get(k, p);
    s.solved &= pivot > 0.;
    take_sqrt(pivot);
    s.A.set(row_of(k) + k, pivot);
    smallest = ((p > 0.) & (pivot < smallest)) ? pivot : smallest;
    largest = ((p > 0.) & (pivot > largest)) ? pivot : largest;
    const Lanes one_over = 1. / pivot;
    for (std::size_t i = k + 1; i < s.rows; ++i) {
      s.A.get(row_of(i) + k, x);
      x *= one_over;
      s.A.set(row_of(i) + k, x);
      s.v.set(i, x);
    }
    for (std::size_t i = k + 1; i < s.rows; ++i) {
      s.v.get(i, y);
      subtract_scaled(y, s.v.from(k + 1), i - k, s.A.from(row_of(i) + k + 1));
    }
  }
  s.solved &= smallest > min_pivot_ratio * largest;
}

/// Solves [31] in the coordinates of the reflectors: A22 z = d2, then R c = d1 - A12 z, and a = Q [0; z]. c
/// is left in the first rows of d.
HOOKE_INLINE void solve(System& s) {
  constexpr std::size_t m = quadratic_monomials;
  Lanes x, y, pivot;
  for (std::size_t k = m; k < s.rows; ++k) {
    const LaneArray row = s.A.from(row_of(k));
    Lanes known = {};
    add_products(row.from(m), s.a.from(m), k - m, known);
    row.get(k, pivot);
    s.d.get(k, x);
    s.a.set(k, (x - known) / pivot);
  }
  for (std::size_t k = s.rows; k-- > m;) {
    const LaneArray row = s.A.from(row_of(k));
    row.get(k, pivot);
    s.a.get(k, x);
    x /= pivot;
    s.a.set(k, x);
    subtract_scaled(x, row.from(m), k - m, s.a.from(m));
    subtract_scaled(x, row, m, s.d);
  }
  for (std::size_t k = m; k-- > 0;) {
    s.d.get(k, x);
    s.P.get(k * s.rows + k, pivot);
    x /= pivot;
    s.d.set(k, x);
    subtract_scaled(x, s.P.from(k * s.rows), k, s.d);
  }
  for (std::size_t k = 0; k < m; ++k) s.a.set(k, Lanes{});
  for (std::size_t k = m; k-- > 0;) {
    const LaneArray below = s.P.from(k * s.rows + k + 1);
    s.a.get(k, y);
    x = y;
    add_products(below, s.a.from(k + 1), s.rows - k - 1, x);
    x *= s.tau[k];
    s.a.set(k, y - x);
    subtract_scaled(x, below, s.rows - k - 1, s.a.from(k + 1));
  }
}

HOOKE_SIMD void solve_system(System& s, Kernel kernel, double min_distance) {
  fill_polynomials(s);
  factor_polynomials(s);
  fill_kernel_matrix(kernel, min_distance, s);
  for (std::size_t k = 0; k < quadratic_monomials; ++k) reflect(s, k);
  factor_kernel_matrix(s);
  solve(s);
}

}  // namespace

void SplineData::clear(std::size_t capacity) {
  centres.resize(3, static_cast<Eigen::Index>(capacity));
  values.resize(static_cast<Eigen::Index>(capacity));
  count = 0;
}

void SplineData::add(const Vec3& centre, double value) {
  centres.col(count) = centre;
  values[count++] = value;
}

void SplineData::drop_repeated(double distance) {
  Eigen::Index kept = 0;
  for (Eigen::Index i = 0; i < count; ++i) {
    const Vec3 centre = centres.col(i);
    const auto before = centres.leftCols(kept).colwise();
    if (std::any_of(before.begin(), before.end(),
                    [&](const auto& c) { return (c - centre).squaredNorm() < distance * distance; }))
      continue;
    centres.col(kept) = centre;
    values[kept++] = values[i];
  }
  count = kept;
}

void SplineGroup::gather(const Data& data, const Flags& requested) {
  size_ = 0;
  for (std::size_t lane = 0; lane < lane_count; ++lane)
    if (requested[lane]) size_ = std::max<std::size_t>(size_, data[lane].count);
  centres_.assign(3 * size_ * lane_count, 0);
  present_.assign(size_ * lane_count, 0);
  right_side_.assign(size_ * lane_count, 0);
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    if (!requested[lane]) continue;
    const SplineData& one = data[lane];
    for (Eigen::Index i = 0; i < one.count; ++i) {
      const std::size_t at = i * lane_count + lane;
      for (std::size_t k = 0; k < 3; ++k)
        centres_[(3 * i + k) * lane_count + lane] = one.centres(static_cast<Eigen::Index>(k), i);
      present_[at] = 1;
      right_side_[at] = one.values[i];
    }
  }
  matrix_.resize(row_of(size_) * lane_count);
  monomials_.resize(quadratic_monomials * size_ * lane_count);
  solution_.resize(size_ * lane_count);
  workspace_.resize(2 * size_ * lane_count);
}

SplineGroup::Flags SplineGroup::fit(const Data& data, const Flags& requested, Kernel kernel,
                                    double min_distance) {
  gather(data, requested);
  if (size_ <= quadratic_monomials) return {};
  System s{.rows = size_,
           .centres = LaneArray(centres_.data()),
           .present = LaneArray(present_.data()),
           .A = LaneArray(matrix_.data()),
           .P = LaneArray(monomials_.data()),
           .d = LaneArray(right_side_.data()),
           .a = LaneArray(solution_.data()),
           .v = LaneArray(workspace_.data()),
           .w = LaneArray(workspace_.data() + size_ * lane_count),
           .tau = {},
           .solved = ~LaneMask{}};
  solve_system(s, kernel, min_distance);
  Flags solved;
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    solved[lane] = requested[lane] && s.solved[lane] != 0;
    for (std::size_t i = 0; i < size_ && solved[lane]; ++i)
      solved[lane] = std::isfinite(solution_[i * lane_count + lane]) &&
                     (i >= quadratic_monomials || std::isfinite(right_side_[i * lane_count + lane]));
  }
  return solved;
}

SplineCoefficients SplineGroup::solution(std::size_t lane, std::size_t centres) const {
  SplineCoefficients spline{.radial = std::vector<double>(centres)};
  for (std::size_t i = 0; i < centres; ++i) spline.radial[i] = solution_[i * lane_count + lane];
  for (std::size_t k = 0; k < quadratic_monomials; ++k)
    spline.polynomial[k] = right_side_[k * lane_count + lane];
  return spline;
}

}  // namespace hooke
