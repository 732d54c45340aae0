#include "hooke/retraction.h"

#include <numeric>

#include "hooke/parallel.h"

namespace hooke {
namespace {
constexpr size_t block = 256;
}

ProjectionCounts& ProjectionCounts::operator+=(const ProjectionCounts& other) {
  calls += other.calls;
  evaluations += other.evaluations;
  for (size_t s = 0; s < by_status.size(); ++s) by_status[s] += other.by_status[s];
  return *this;
}

Retraction::Retraction(Surface surface, const Constraints& constraints, const RetractionOptions& options)
    : surface_(std::move(surface)),
      constraints_(constraints),
      options_(options),
      status_(constraints.freedom.size()),
      evaluations_(constraints.freedom.size(), 0) {}

Placement Retraction::place(const Mat3X& points, std::vector<int> anchors, std::vector<int> segments) {
  Placement p;
  p.points = points;
  p.normals = Mat3X::Zero(3, points.cols());
  p.tangents = Mat3X::Zero(3, points.cols());
  p.anchors = std::move(anchors);
  p.segments = std::move(segments);
  p.drift.assign(static_cast<size_t>(points.cols()), 0);
  parallel_for(static_cast<size_t>(points.cols()), block, [&](size_t begin, size_t end) {
    for (size_t v = begin; v < end; ++v) move(p, Vec3::Zero(), static_cast<int>(v), 0, p);
  });
  count();
  return p;
}

void Retraction::move(const Placement& from, const Vec3& displacement, int vertex, double lazy,
                      Placement& to) {
  const auto v = static_cast<size_t>(vertex);
  const Freedom freedom = constraints_.freedom[v];
  Vec3 x = from.points.col(vertex) + displacement;
  if (freedom == Freedom::fixed) x = from.points.col(vertex);
  if (freedom == Freedom::curve) {
    const Curve& curve = constraints_.curves[static_cast<size_t>(constraints_.curve[v])];
    const CurveFoot foot = project_to_curve(curve, x, from.segments[v]);
    x = foot.point;
    to.tangents.col(vertex) = foot.tangent;
    to.segments[v] = foot.segment;
  }
  const double step = displacement.norm();
  const double drift = from.drift[v] + step;
  if (drift < lazy || (step == 0 && lazy > 0)) {
    to.points.col(vertex) = x;
    to.normals.col(vertex) = from.normals.col(vertex);
    to.anchors[v] = from.anchors[v];
    to.drift[v] = drift;
    return;
  }
  const Foot foot = surface_(x, from.anchors[v], options_.tolerance);
  status_[v] = foot.status;
  evaluations_[v] += foot.evaluations;
  // On a curve or a corner the surface only tells the normal: the curve itself is the constraint.
  to.points.col(vertex) = freedom == Freedom::surface ? foot.point : x;
  to.normals.col(vertex) = foot.normal;
  to.anchors[v] = foot.anchor;
  to.drift[v] = 0;
}

void Retraction::step(const Placement& from, const Mat3X& displacement, std::span<const int> vertices,
                      Placement& to) {
  parallel_for(vertices.size(), block, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i)
      move(from, displacement.col(vertices[i]), vertices[i], options_.lazy, to);
  });
  count();
}

void Retraction::step(const Placement& from, const Mat3X& displacement, Placement& to) {
  to.points.resize(3, from.points.cols());
  to.normals.resize(3, from.points.cols());
  to.tangents = from.tangents;
  to.anchors.resize(from.anchors.size());
  to.segments = from.segments;
  to.drift.resize(from.drift.size());
  parallel_for(static_cast<size_t>(from.points.cols()), block, [&](size_t begin, size_t end) {
    for (size_t v = begin; v < end; ++v)
      move(from, displacement.col(static_cast<Eigen::Index>(v)), static_cast<int>(v), options_.lazy, to);
  });
  count();
}

void Retraction::settle(Placement& placement) {
  parallel_for(placement.drift.size(), block, [&](size_t begin, size_t end) {
    for (size_t v = begin; v < end; ++v)
      if (placement.drift[v] > 0) move(placement, Vec3::Zero(), static_cast<int>(v), 0, placement);
  });
  count();
}

void Retraction::constrain(const Placement& at, Mat3X& vectors) const {
  parallel_for(static_cast<size_t>(vectors.cols()), 4096, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const auto v = static_cast<Eigen::Index>(i);
      auto u = vectors.col(v);
      switch (constraints_.freedom[i]) {
        case Freedom::surface:
          u -= at.normals.col(v) * at.normals.col(v).dot(u);
          break;
        case Freedom::curve:
          u = (at.tangents.col(v) * at.tangents.col(v).dot(u)).eval();
          break;
        case Freedom::fixed:
          u.setZero();
          break;
      }
    }
  });
}

void Retraction::count() {
  for (size_t v = 0; v < evaluations_.size(); ++v) {
    if (evaluations_[v] == 0) continue;
    ++counts_.calls;
    counts_.evaluations += evaluations_[v];
    ++counts_.by_status[static_cast<size_t>(status_[v])];
    evaluations_[v] = 0;
  }
}

}  // namespace hooke
