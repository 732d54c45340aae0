// Small splines of the same kind, four at a time: one in each lane.
#pragma once

#include "hooke/core/simd.h"
#include "hooke/filter/thin_plate_spline.h"

namespace hooke {

/// What one spline is fitted to: values at centres of size 1 about the origin.
struct SplineData {
  Mat3X centres;
  Eigen::VectorXd values;
  Eigen::Index count = 0;

  /// Makes room for so many centres and forgets those that are there.
  void clear(std::size_t capacity);
  void add(const Vec3& centre, double value);
  /// Drops centres closer than `distance` to one before them.
  void drop_repeated(double distance);
};

/// Fits splines with a quadratic part, as fit_spline does, to at most four sets of data. Which others are in
/// its group changes no result. Made once for many groups, for its memory.
class SplineGroup {
 public:
  using Data = std::array<SplineData, lane_count>;
  using Flags = std::array<bool, lane_count>;

  /// Fits the lanes that `wanted` names; tells which of these have a solution. None has one whose centres
  /// do not determine it, or where two are closer than `min_distance`.
  Flags fit(const Data& data, const Flags& wanted, Kernel kernel, double min_distance);

  /// The spline of a lane. Pre-condition: fit() found one to so many centres.
  SplineCoefficients solution(std::size_t lane, std::size_t centres) const;

 private:
  void gather(const Data& data, const Flags& wanted);

  std::size_t size_ = 0;           // centres of the largest set
  std::vector<double> centres_;    // x, y, z of each
  std::vector<double> present_;    // 1 where the lane has that centre, 0 where it is filled up
  std::vector<double> matrix_;     // lower triangle, row by row
  std::vector<double> monomials_;  // ten rows; then the reflectors that make them R
  std::vector<double> right_side_, solution_, work_;
};

}  // namespace hooke
