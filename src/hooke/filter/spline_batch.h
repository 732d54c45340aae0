// Fits small thin-plate splines of the same kind four at a time, one per SIMD lane.
#pragma once

#include "hooke/core/simd.h"
#include "hooke/filter/thin_plate_spline.h"

namespace hooke {

/// The data that one spline is fitted to: values at centres of size 1 about the origin.
struct SplineData {
  Mat3X centres;
  Eigen::VectorXd values;
  Eigen::Index count = 0;

  /// Removes all centres and makes room for `capacity` new ones.
  void clear(std::size_t capacity);
  void add(const Vec3& centre, double value);
  /// Drops centres closer than `distance` to an earlier one.
  void drop_repeated(double distance);
};

/// Fits splines with a quadratic part, as fit_spline() does, to at most four sets of data. The result of a
/// lane does not depend on the other lanes. Meant to be reused for many groups, for its memory.
class SplineGroup {
 public:
  using Data = std::array<SplineData, lane_count>;
  using Flags = std::array<bool, lane_count>;

  /// Fits the lanes flagged in `requested`; returns which of these have a solution. There is none if the
  /// centres do not determine it, or if two are closer than `min_distance`.
  Flags fit(const Data& data, const Flags& requested, Kernel kernel, double min_distance);

  /// The spline of a lane. Pre-condition: fit() found one for this lane and this number of centres.
  SplineCoefficients solution(std::size_t lane, std::size_t centres) const;

 private:
  void gather(const Data& data, const Flags& requested);

  std::size_t size_ = 0;           // centres of the largest set
  std::vector<double> centres_;    // x, y, z of each
  std::vector<double> present_;    // 1 where the lane has that centre, 0 for padding
  std::vector<double> matrix_;     // lower triangle, row by row
  std::vector<double> monomials_;  // ten columns; after the factorization R and the reflectors
  std::vector<double> right_side_, solution_, workspace_;
};

}  // namespace hooke
