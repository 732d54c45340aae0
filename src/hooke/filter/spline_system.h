// The equations of four splines with a quadratic part, one in each lane, and their solution.
#pragma once

#include "hooke/core/lanes.h"
#include "hooke/filter/thin_plate_spline.h"

namespace hooke::spline_lanes {

constexpr std::size_t monomials = monomial_count(2);

/// Row i of a lower triangle begins here.
constexpr std::size_t row_of(std::size_t i) {
  return i * (i + 1) / 2;
}

/// An array of numbers in lanes.
class LaneArray {
 public:
  explicit LaneArray(double* data) : data_(data) {}
  HOOKE_INLINE void get(std::size_t i, Lanes& x) const { load(data_ + lane_count * i, x); }
  HOOKE_INLINE void set(std::size_t i, const Lanes& x) const { store(x, data_ + lane_count * i); }
  HOOKE_INLINE LaneArray from(std::size_t i) const { return LaneArray(data_ + lane_count * i); }

 private:
  double* data_;
};

/// The system of a group. `rows` centres, of which those that a lane lacks are filled up: their rows hold
/// nothing but a 1 in the diagonal.
struct System {
  std::size_t rows;
  LaneArray centres, present;
  LaneArray A;  // lower triangle, row by row
  LaneArray P;  // column by column; R, and below it the reflectors
  LaneArray d, a, v, w;
  Lanes tau[monomials];
  LaneMask solved;
};

/// Leaves the coefficients of the centres in `a`, those of the polynomials in the first rows of `d`, and in
/// `solved` which lanes have a solution. [31], [32]
void solve_system(System& system, Kernel kernel, double least_distance);

}  // namespace hooke::spline_lanes
