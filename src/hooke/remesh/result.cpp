#include "hooke/remesh/result.h"

#include <algorithm>
#include <cmath>

#include "hooke/geometry/triangle.h"
#include "hooke/mesh/disjoint_sets.h"
#include "hooke/mesh/topology.h"
#include "hooke/mesh/wedges.h"
#include "hooke/remesh/limiting_factors.h"
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

CreaseCounts count_creases(const Adjacency& c, const Permutation& order,
                           const std::vector<unsigned char>& vertex_limits) {
  constexpr unsigned char fixed = limited_at_corner | limited_by_request | put_back;
  CreaseCounts counts;
  const std::vector<Edge> edges = crease_edges(c);
  if (edges.empty()) return counts;
  counts.edges = static_cast<int>(edges.size());
  counts.charts = measure_topology(cut_open(c)).components;
  std::vector<int> crease_at(c.vertex_count, -1);  // one of those at the vertex
  std::vector<char> is_corner(c.vertex_count, 0);
  DisjointSets curves(edges.size());
  for (std::size_t e = 0; e < edges.size(); ++e)
    for (int v : edges[e]) {
      const bool is_first = crease_at[v] < 0;
      if (is_first) {
        crease_at[v] = static_cast<int>(e);
        is_corner[v] = (vertex_limits[order.old_vertex[v]] & fixed) != 0;
        ++(is_corner[v] ? counts.corners : counts.curve_vertices);
      } else if (!is_corner[v]) {
        curves.join({crease_at[v], static_cast<int>(e)});
      }
    }
  for (std::size_t e = 0; e < edges.size(); ++e)
    counts.curves += curves.root(static_cast<int>(e)) == static_cast<int>(e);
  return counts;
}

}  // namespace hooke
