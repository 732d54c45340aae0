#include "hooke/filter/surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hooke/core/parallel.h"

namespace hooke {
namespace {

constexpr std::size_t surface_block = 1024;

/// Minimum spread of the edges across their main direction over that along it, squared.
constexpr double min_spread = 1e-3;

/// Shape operator at a vertex: the least-squares solution M of M d = turn over its edges, made symmetric.
ShapeOperator fit_shape_operator(const Mat3X& points, const Mat3X& normals, const Adjacency& c, int v) {
  const auto neighbours = c.vertex_neighbours[v];
  if (neighbours.empty() || normals.col(v).isZero(0)) return unknown_shape_operator();
  const Vec3 n = normals.col(v);
  Eigen::Matrix<double, 3, 2> basis;
  basis.col(0) = n.unitOrthogonal();
  basis.col(1) = n.cross(basis.col(0));
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero(), turned = Eigen::Matrix2d::Zero();
  for (int w : neighbours) {
    const Eigen::Vector2d edge = basis.transpose() * (points.col(w) - points.col(v));
    const Eigen::Vector2d turn = basis.transpose() * (normals.col(w) - normals.col(v));
    spread += edge * edge.transpose();
    turned += turn * edge.transpose();
  }
  const double size = spread.trace();
  if (!(spread.determinant() > min_spread * size * size)) return unknown_shape_operator();
  const Eigen::Matrix2d shape = turned * spread.inverse();
  const Eigen::Matrix2d symmetric = .5 * (shape + shape.transpose());
  return {.shape = SymmetricMatrix(basis * symmetric * basis.transpose())};
}

}  // namespace

ShapeOperator unknown_shape_operator() {
  return {.change = std::numeric_limits<float>::infinity()};
}

std::vector<ShapeOperator> shape_operators(const Mat3X& points, const Mat3X& normals, const Adjacency& c) {
  const std::size_t n = c.vertex_count;
  std::vector<ShapeOperator> shape_operators(n);
  parallel_for(n, surface_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v)
      shape_operators[v] = fit_shape_operator(points, normals, c, static_cast<int>(v));
  });
  std::vector<float> change(n);
  parallel_for(n, surface_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      change[v] = shape_operators[v].change;  // still infinite or 0
      if (std::isinf(change[v])) continue;
      double squares = 0;
      const auto neighbours = c.vertex_neighbours[static_cast<int>(v)];
      for (int w : neighbours) {
        const Vec3 edge = points.col(w) - points.col(static_cast<Eigen::Index>(v));
        const auto normal = normals.col(static_cast<Eigen::Index>(v));
        Vec3 turn = shape_operators[v].shape * edge - shape_operators[w].shape * edge;
        turn -= normal.dot(turn) * normal;  // without the rotation of the tangent plane
        if (!edge.isZero(0)) squares += turn.squaredNorm() / edge.squaredNorm();
      }
      if (!neighbours.empty())
        change[v] = static_cast<float>(std::sqrt(squares / static_cast<double>(neighbours.size())));
    }
  });
  parallel_for(n, surface_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      shape_operators[v].change = change[v];
      for (int w : c.vertex_neighbours[static_cast<int>(v)])
        shape_operators[v].change = std::max(shape_operators[v].change, change[w]);
    }
  });
  return shape_operators;
}

ProjectionCounts& ProjectionCounts::operator+=(const ProjectionCounts& other) {
  calls += other.calls;
  evaluations += other.evaluations;
  for (size_t s = 0; s < by_status.size(); ++s) by_status[s] += other.by_status[s];
  return *this;
}

Projection project_by_newton(const ScalarField& psi, const Vec3& x, int hint, const NewtonOptions& options) {
  Projection projection{x, Vec3::Zero(), hint, ProjectionStatus::converged, 0};
  const auto fail = [&](ProjectionStatus status) {
    return Projection{x, Vec3::Zero(), hint, status, projection.evaluations};
  };
  double last_distance = options.convergence > 0 ? 1 / options.convergence : 0;
  constexpr int max_steps = 12;
  for (int step = 0; step <= max_steps; ++step) {
    const FieldSample s = psi(projection.point, hint);
    ++projection.evaluations;
    if (s.value == 0 && s.gradient.isZero(0)) return fail(ProjectionStatus::no_cover);
    const double slope = s.gradient.norm();
    if (!(slope >= options.min_gradient)) return fail(ProjectionStatus::flat_gradient);
    const double distance = s.value / slope;
    projection.normal = s.gradient / slope;
    if (std::abs(distance) <= options.tolerance) return projection;

    projection.point -=
        std::clamp(distance, -options.longest_step, options.longest_step) * projection.normal;  // [16]
    if (!((projection.point - x).norm() <= options.longest_move)) return fail(ProjectionStatus::too_far);
    // Convergence accelerates: the rate of the last step bounds the error that this one leaves.
    if (distance * distance <= options.tolerance * std::abs(last_distance)) return projection;
    last_distance = distance;
  }
  return fail(ProjectionStatus::step_limit);
}

}  // namespace hooke
