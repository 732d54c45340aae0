#include "hooke/filter/patch_grower.h"

#include <algorithm>

namespace hooke {
namespace {

constexpr double least_normal_agreement = -.2;  // with the centre: stops at the other sheet of a thin body
constexpr double tie = 1 + 1e-6;                // of distances: rounding must not choose between equals

std::size_t idx(int i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

PatchGrower::PatchGrower(const Eigen::Ref<const Mat3X>& points, const Connectivity& connectivity,
                         const Mat3X& normals, const std::vector<char>& unfolded)
    : points_(points),
      connectivity_(connectivity),
      normals_(normals),
      unfolded_(unfolded),
      met_by_(idx(connectivity.vertex_count), -1),
      held_by_(idx(connectivity.vertex_count), -1) {}

void PatchGrower::grow(int centre, int size) {
  axis_ = axis_at(centre);
  search(centre, idx(size + size / 2));
  distances_.clear();
  for (int m : members_) distances_.push_back((points_.col(m) - points_.col(centre)).norm());
  std::vector<double> sorted = distances_;
  const auto last = sorted.begin() + std::min(size, static_cast<int>(sorted.size())) - 1;
  std::nth_element(sorted.begin(), last, sorted.end());
  farthest_ = *last;

  std::size_t kept = 0;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (distances_[i] > farthest_ * tie) continue;
    members_[kept] = members_[i];
    distances_[kept++] = distances_[i];
    held_by_[idx(members_[i])] = round_;
  }
  members_.resize(kept);
  distances_.resize(kept);
}

bool PatchGrower::is_inside(int vertex) const {
  return std::ranges::all_of(connectivity_.vertex_neighbours[vertex],
                             [&](int n) { return held_by_[idx(n)] == round_ || !is_admitted(n); });
}

/// A folded vertex is admitted whatever its normal, which means nothing.
bool PatchGrower::is_admitted(int vertex) const {
  return !unfolded_[idx(vertex)] || normals_.col(vertex).dot(axis_) > least_normal_agreement;
}

/// The normal of the centre or, where that means nothing, of its neighbours.
Vec3 PatchGrower::axis_at(int centre) const {
  Vec3 sum = Vec3::Zero();
  if (!unfolded_[idx(centre)])
    for (int n : connectivity_.vertex_neighbours[centre])
      if (unfolded_[idx(n)]) sum += normals_.col(n);
  return sum.isZero(0) ? Vec3(normals_.col(centre)) : sum.normalized();
}

void PatchGrower::search(int centre, std::size_t most) {
  ++round_;
  members_.assign(1, centre);
  met_by_[idx(centre)] = round_;
  for (std::size_t i = 0; i < members_.size(); ++i)
    for (int n : connectivity_.vertex_neighbours[members_[i]]) {
      if (members_.size() >= most) return;
      if (met_by_[idx(n)] == round_) continue;
      met_by_[idx(n)] = round_;
      if (is_admitted(n)) members_.push_back(n);
    }
}

}  // namespace hooke
