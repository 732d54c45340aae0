#include "hooke/filter/spline_group.h"

#include <algorithm>
#include <cmath>

#include "hooke/filter/spline_system.h"

namespace hooke {

using namespace spline_lanes;

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

void SplineGroup::gather(const Data& data, const Flags& wanted) {
  size_ = 0;
  for (std::size_t lane = 0; lane < lane_count; ++lane)
    if (wanted[lane]) size_ = std::max(size_, static_cast<std::size_t>(data[lane].count));
  centres_.assign(3 * size_ * lane_count, 0);
  present_.assign(size_ * lane_count, 0);
  right_side_.assign(size_ * lane_count, 0);
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    if (!wanted[lane]) continue;
    const SplineData& one = data[lane];
    for (Eigen::Index i = 0; i < one.count; ++i) {
      const std::size_t at = static_cast<std::size_t>(i) * lane_count + lane;
      for (std::size_t k = 0; k < 3; ++k)
        centres_[(3 * static_cast<std::size_t>(i) + k) * lane_count + lane] =
            one.centres(static_cast<Eigen::Index>(k), i);
      present_[at] = 1;
      right_side_[at] = one.values[i];
    }
  }
  matrix_.resize(row_of(size_) * lane_count);
  monomials_.resize(monomials * size_ * lane_count);
  solution_.resize(size_ * lane_count);
  work_.resize(2 * size_ * lane_count);
}

SplineGroup::Flags SplineGroup::fit(const Data& data, const Flags& wanted, Kernel kernel,
                                    double least_distance) {
  gather(data, wanted);
  if (size_ <= monomials) return {};
  System s{.rows = size_,
           .centres = LaneArray(centres_.data()),
           .present = LaneArray(present_.data()),
           .A = LaneArray(matrix_.data()),
           .P = LaneArray(monomials_.data()),
           .d = LaneArray(right_side_.data()),
           .a = LaneArray(solution_.data()),
           .v = LaneArray(work_.data()),
           .w = LaneArray(work_.data() + size_ * lane_count),
           .tau = {},
           .solved = ~LaneMask{}};
  solve_system(s, kernel, least_distance);
  Flags solved;
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    solved[lane] = wanted[lane] && s.solved[lane] != 0;
    for (std::size_t i = 0; i < size_ && solved[lane]; ++i)
      solved[lane] = std::isfinite(solution_[i * lane_count + lane]) &&
                     (i >= monomials || std::isfinite(right_side_[i * lane_count + lane]));
  }
  return solved;
}

SplineCoefficients SplineGroup::solution(std::size_t lane, std::size_t centres) const {
  SplineCoefficients spline{.radial = std::vector<double>(centres)};
  for (std::size_t i = 0; i < centres; ++i) spline.radial[i] = solution_[i * lane_count + lane];
  for (std::size_t k = 0; k < monomials; ++k) spline.polynomial[k] = right_side_[k * lane_count + lane];
  return spline;
}

}  // namespace hooke
