#include "hooke/integrator/time_step.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"

namespace hooke {
namespace {

/// Combines value(i) over [0, count). The grouping is fixed, so that the result does not depend on threads.
template <typename T, typename Value, typename Combine>
T reduce(std::size_t count, T start, const Value& value, const Combine& combine) {
  constexpr std::size_t block = 1024;
  const std::size_t blocks = (count + block - 1) / block;
  std::vector<T> partial(blocks, start);
  parallel_for(blocks, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b)
      for (std::size_t i = b * block; i < std::min(count, (b + 1) * block); ++i)
        partial[b] = combine(partial[b], value(i));
  });
  T result = start;
  for (const T& p : partial) result = combine(result, p);
  return result;
}

double longest_column(const Eigen::Ref<const Mat3X>& m) {
  return reduce(
      m.cols(), 0., [&](std::size_t i) { return m.col(i).norm(); },
      [](double a, double b) { return std::max(a, b); });
}

FailedTests union_of(const FailedTests& a, const FailedTests& b) {
  return {a.angle || b.angle, a.expansion || b.expansion, a.displacement || b.displacement,
          a.area_bound || b.area_bound};
}

/// The comparisons are written so that NaN fails.
FailedTests test_face(const FaceShape& before, const FaceShape& after, const TimeStepOptions& o) {
  FailedTests failed;
  if (before.degenerate()) return failed;
  failed.angle = !(before.normal.dot(after.normal) > o.angle);
  failed.expansion = after.degenerate() || !(std::abs(1 - after.area / before.area) <= o.expansion);
  failed.area_bound = !(after.area > o.area_bound);
  return failed;
}

}  // namespace

StepScales step_scales(const Eigen::Ref<const Mat3X>& points, const Eigen::Ref<const Mat3X>& velocities,
                       const Eigen::Ref<const Mat3X>& forces, const Adjacency& c) {
  constexpr double none = std::numeric_limits<double>::infinity();
  const auto length = [&](std::size_t e) {
    const double l = (points.col(c.edges[e][1]) - points.col(c.edges[e][0])).norm();
    return l > 0 ? l : none;
  };
  const double shortest =
      reduce(c.edges.size(), none, length, [](double a, double b) { return std::min(a, b); });
  return {shortest, longest_column(velocities), longest_column(forces)};
}

double base_step(const StepScales& s, double mass) {
  assert(mass > 0);
  // The root of [24] without cancellation, which also has its limits at velocity or force 0.
  return 2 * s.edge / (s.velocity + std::hypot(s.velocity, std::sqrt(2 * s.force * s.edge / mass)));
}

FailedTests test_step(const Eigen::Ref<const Mat3X>& before, const Eigen::Ref<const Mat3X>& after,
                      const Adjacency& c, double shortest_edge, const TimeStepOptions& options) {
  const auto face = [&](std::size_t f) {
    return test_face(face_shape(before, c.faces[f]), face_shape(after, c.faces[f]), options);
  };
  const auto vertex = [&](std::size_t v) {
    FailedTests failed;
    failed.displacement = !((after.col(v) - before.col(v)).norm() < options.displacement * shortest_edge);
    return failed;
  };
  return union_of(reduce(c.faces.size(), FailedTests{}, face, union_of),
                  reduce(before.cols(), FailedTests{}, vertex, union_of));
}

void BoundCounts::add(const FailedTests& bound) {
  angle += bound.angle;
  expansion += bound.expansion;
  displacement += bound.displacement;
  area_bound += bound.area_bound;
  none += !bound.any();
}

BoundCounts& BoundCounts::operator+=(const BoundCounts& other) {
  angle += other.angle;
  expansion += other.expansion;
  displacement += other.displacement;
  area_bound += other.area_bound;
  none += other.none;
  return *this;
}

AdaptedStep adapt_step(double base, double last_factor, double floor,
                       const std::function<FailedTests(double time)>& test) {
  AdaptedStep step;
  for (step.factor = 2 * last_factor; base * step.factor >= floor; step.factor /= 2) {
    step.time = base * step.factor;
    const FailedTests failed = test(step.time);
    if (!failed.any()) return step;
    step.bound = failed;
    ++step.rejected;
  }
  step.time = 0;
  step.jammed = true;
  return step;
}

}  // namespace hooke
