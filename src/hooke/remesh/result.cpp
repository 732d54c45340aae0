#include "hooke/remesh/result.h"

#include <algorithm>
#include <cmath>

#include "hooke/constraints/constraints.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/wedges.h"
#include "hooke/working_mesh/workspace.h"

namespace hooke {

IterationRecord iteration_record(const Workspace& work, const char* stage, const IntegrationResult& done) {
  IterationRecord record{
      .stage = stage, .steps = done.steps, .evaluations = done.evaluations, .energy = done.energy};
  const Mat3X& points = work.vertices.positions.points;
  const auto& edges = work.adjacency->edges;
  double sum2 = 0;
  for (size_t e = 0; e < edges.size(); ++e) {
    const double l = (points.col(edges[e][1]) - points.col(edges[e][0])).norm();
    const double error = std::abs(l / work.targets.edge[e] - 1);
    record.max_length_error = std::max(record.max_length_error, error);
    sum2 += error * error;
  }
  record.rms_length_error = std::sqrt(sum2 / static_cast<double>(edges.size()));
  record.min_angle = min_angle(points, work.adjacency->faces);
  record.field_evaluations = work.projection_counts().evaluations;
  return record;
}

CreaseCounts count_creases(const Workspace& work) {
  const Constraints& constraints = work.vertices.constraints;
  CreaseCounts counts;
  if (constraints.creases.empty()) return counts;
  counts.curves = constraints.crease_curves;
  counts.edges = static_cast<int>(constraints.creases.size());
  counts.kept = static_cast<int>(crease_edges(*work.adjacency).size());
  counts.charts = work.chart_count();
  std::vector<int> ends;
  for (const Edge& e : constraints.creases) ends.insert(ends.end(), e.begin(), e.end());
  std::ranges::sort(ends);
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  for (int v : ends) {
    const bool inner = constraints.freedom[v] == Freedom::curve || constraints.at_bend(v) ||
                       constraints.slides_with_copies(v);
    ++(inner ? counts.curve_vertices : counts.corners);
  }
  return counts;
}

std::vector<int> faces_of_result(const Workspace& work, const std::vector<int>& faces) {
  std::vector<int> ids;
  ids.reserve(faces.size());
  for (int f : faces) ids.push_back(work.order.old_face[f]);
  std::ranges::sort(ids);
  return ids;
}

}  // namespace hooke
