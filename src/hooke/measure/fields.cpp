#include "hooke/measure/fields.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hooke/geometry/triangle.h"
#include "hooke/mesh/curvature.h"

namespace hooke {
namespace {

std::vector<double> length_errors(const Mat3X& points, const Adjacency& c, const UniformVector& targets) {
  std::vector<double> worst(c.vertex_count, 0);
  for (size_t e = 0; e < c.edges.size(); ++e) {
    const auto& [v, w] = c.edges[e];
    const double error = std::abs((points.col(v) - points.col(w)).norm() - targets[e]) / targets[e];
    for (int end : {v, w}) {
      double& at_vertex = worst[end];
      at_vertex = std::max(at_vertex, error);
    }
  }
  return worst;
}

}  // namespace

Fields measure_fields(const Mat3X& points, const Adjacency& c, const UniformVector& edge_targets,
                      const std::vector<double>& distances, const Mat3X* start) {
  Fields fields;
  const auto add = [](VertexData& data, const char* name, std::vector<double> values) {
    data.push_back({name, NumberType::float64, std::move(values)});
  };
  if (start) {
    std::vector<double> moved(c.vertex_count);
    for (size_t v = 0; v < moved.size(); ++v)
      moved[v] = (points.col(static_cast<Eigen::Index>(v)) - start->col(static_cast<Eigen::Index>(v))).norm();
    add(fields.vertices, "displacement", std::move(moved));
  }
  add(fields.vertices, "distance", distances);
  VertexCurvature curvature = measure_curvature(points, c);
  add(fields.vertices, "mean_curvature", std::move(curvature.mean));
  add(fields.vertices, "gaussian_curvature", std::move(curvature.gaussian));
  add(fields.vertices, "length_error", length_errors(points, c, edge_targets));
  std::vector<double> angles;
  for (const Triangle& face : c.faces) angles.push_back(angle_with_cotangent(max_cotangent(points, face)));
  add(fields.faces, "min_angle", std::move(angles));
  return fields;
}

}  // namespace hooke
