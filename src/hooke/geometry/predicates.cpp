#include "hooke/geometry/predicates.h"

#include <algorithm>
#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <span>

namespace hooke {
namespace {

namespace mp = boost::multiprecision;
template <unsigned bits>  // of fixed width, on the stack
using FixedInteger =
    mp::number<mp::cpp_int_backend<bits, bits, mp::signed_magnitude, mp::unchecked, void>, mp::et_off>;
using SmallInteger = FixedInteger<512>;  // wide enough for the coordinates of almost any mesh
using WideInteger = FixedInteger<6400>;  // for any three factors: doubles span 2^-1074 to 2^1024

// Shewchuk's bounds (3 + 16 eps) eps and (7 + 56 eps) eps, rounded up.
constexpr double relative_error_2d = 3.4e-16;
constexpr double relative_error_3d = 7.8e-16;
// The bounds do not cover underflow. For differences below 1e100 underflow adds less than this.
constexpr double underflow_error = 1e-200;
constexpr double max_difference = 1e100;

/// A finite double as mantissa * 2^exponent with an odd mantissa (or zero).
struct Binary {
  std::int64_t mantissa;
  int exponent;
};

Binary to_binary(double x) {
  if (x == 0) return {0, 0};
  int exponent;
  auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
  const int zeros = std::countr_zero(static_cast<std::uint64_t>(mantissa));
  return {mantissa >> zeros, exponent - 53 + zeros};
}

/// Range of exponents of all binary digits: each number is an integer times 2^lowest and below 2^highest in
/// size.
struct Digits {
  int lowest = 0;
  int highest = 0;
  int width() const { return highest - lowest; }
};

Digits digits_of(std::span<const Binary> numbers) {
  Digits d;
  bool first = true;
  for (const Binary& b : numbers) {
    if (b.mantissa == 0) continue;
    const int top = b.exponent + 64 - std::countl_zero(static_cast<std::uint64_t>(std::abs(b.mantissa)));
    d.lowest = first ? b.exponent : std::min(d.lowest, b.exponent);
    d.highest = first ? top : std::max(d.highest, top);
    first = false;
  }
  return d;
}

template <typename Integer>
Integer to_integer(const Binary& b, int lowest) {
  Integer i = b.mantissa;
  if (b.mantissa != 0) i <<= static_cast<unsigned>(b.exponent - lowest);
  return i;
}

/// Coordinates as integers at a common scale, which does not change the sign of a determinant.
template <typename Integer, size_t n>
std::array<Integer, n> to_integers(const std::array<Binary, n>& numbers, int lowest) {
  std::array<Integer, n> integers;
  for (size_t i = 0; i < n; ++i) integers[i] = to_integer<Integer>(numbers[i], lowest);
  return integers;
}

template <typename Integer>
int exact_orient2d(const std::array<Binary, 6>& numbers, int lowest) {
  const auto p = to_integers<Integer>(numbers, lowest);
  const Integer left = (p[0] - p[4]) * (p[3] - p[5]);
  const Integer right = (p[1] - p[5]) * (p[2] - p[4]);
  return Integer(left - right).sign();
}

template <typename Integer>
int exact_orient3d(const std::array<Binary, 12>& numbers, int lowest) {
  const auto p = to_integers<Integer>(numbers, lowest);
  std::array<Integer, 9> q;  // b - a, c - a, d - a
  for (size_t i = 0; i < 9; ++i) q[i] = p[i + 3] - p[i % 3];
  const Integer x = q[1] * q[5] - q[2] * q[4];
  const Integer y = q[2] * q[3] - q[0] * q[5];
  const Integer z = q[0] * q[4] - q[1] * q[3];
  return Integer(x * q[6] + y * q[7] + z * q[8]).sign();
}

int exact_orient2d(const Vec2& a, const Vec2& b, const Vec2& c) {
  const std::array<Binary, 6> numbers = {to_binary(a.x()), to_binary(a.y()), to_binary(b.x()),
                                         to_binary(b.y()), to_binary(c.x()), to_binary(c.y())};
  const Digits digits = digits_of(numbers);
  if (2 * (digits.width() + 1) + 1 < 512) return exact_orient2d<SmallInteger>(numbers, digits.lowest);
  return exact_orient2d<WideInteger>(numbers, digits.lowest);
}

int exact_orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  std::array<Binary, 12> numbers;
  for (int i = 0; i < 3; ++i) {
    const size_t k = i;
    numbers[k] = to_binary(a[i]);
    numbers[k + 3] = to_binary(b[i]);
    numbers[k + 6] = to_binary(c[i]);
    numbers[k + 9] = to_binary(d[i]);
  }
  const Digits digits = digits_of(numbers);
  if (3 * (digits.width() + 1) + 3 < 512) return exact_orient3d<SmallInteger>(numbers, digits.lowest);
  return exact_orient3d<WideInteger>(numbers, digits.lowest);
}

}  // namespace

int orient2d(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 u = a - c, v = b - c;
  const double left = u.x() * v.y(), right = u.y() * v.x();
  if ((u.x() == 0 && u.y() == 0) || (v.x() == 0 && v.y() == 0)) return 0;
  if ((u.x() == 0 && v.x() == 0) || (u.y() == 0 && v.y() == 0)) return 0;  // on an axis-parallel line
  const double determinant = left - right;
  const double bound = relative_error_2d * (std::abs(left) + std::abs(right)) + underflow_error;
  const double largest = std::max(u.lpNorm<Eigen::Infinity>(), v.lpNorm<Eigen::Infinity>());
  if (std::abs(determinant) > bound && largest < max_difference) return determinant > 0 ? 1 : -1;
  return exact_orient2d(a, b, c);
}

int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, v = c - a, w = d - a;
  const double xy = u.x() * v.y(), yx = u.y() * v.x();
  const double yz = u.y() * v.z(), zy = u.z() * v.y();
  const double zx = u.z() * v.x(), xz = u.x() * v.z();
  const double determinant = w.x() * (yz - zy) + w.y() * (zx - xz) + w.z() * (xy - yx);
  const double permanent = std::abs(w.x()) * (std::abs(yz) + std::abs(zy)) +
                           std::abs(w.y()) * (std::abs(zx) + std::abs(xz)) +
                           std::abs(w.z()) * (std::abs(xy) + std::abs(yx));
  const double bound = relative_error_3d * permanent + underflow_error;
  const double largest =
      std::max({u.lpNorm<Eigen::Infinity>(), v.lpNorm<Eigen::Infinity>(), w.lpNorm<Eigen::Infinity>()});
  if (std::abs(determinant) > bound && largest < max_difference) return determinant > 0 ? 1 : -1;
  for (int k = 0; k < 3; ++k)  // common: a mesh in an axis-parallel plane
    if (u[k] == 0 && v[k] == 0 && w[k] == 0) return 0;
  return exact_orient3d(a, b, c, d);
}

bool is_collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
  for (int k = 0; k < 3; ++k) {
    const int x = (k + 1) % 3, y = (k + 2) % 3;
    if (orient2d({a[x], a[y]}, {b[x], b[y]}, {c[x], c[y]}) != 0) return false;
  }
  return true;
}

}  // namespace hooke
