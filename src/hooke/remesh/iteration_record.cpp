#include "hooke/remesh/iteration_record.h"

#include <algorithm>
#include <cmath>

#include "hooke/geometry/least_angle.h"

namespace hooke {

IterationRecord iteration_record(const Workspace& work, const char* stage, const IntegrationResult& done) {
  IterationRecord record{
      .stage = stage, .steps = done.steps, .evaluations = done.evaluations, .energy = done.energy};
  const Mat3X& points = work.placement.points;
  const auto& edges = work.connectivity->edges;
  double sum2 = 0;
  for (size_t e = 0; e < edges.size(); ++e) {
    const double l = (points.col(edges[e][1]) - points.col(edges[e][0])).norm();
    const double error = std::abs(l / work.targets.edge[e] - 1);
    record.max_length_error = std::max(record.max_length_error, error);
    sum2 += error * error;
  }
  record.rms_length_error = std::sqrt(sum2 / static_cast<double>(edges.size()));
  record.least_angle = least_angle(points, work.connectivity->faces);
  record.field_evaluations = work.projection_counts().evaluations;
  return record;
}

}  // namespace hooke
