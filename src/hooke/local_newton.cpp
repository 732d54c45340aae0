#include "hooke/local_newton.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "hooke/parallel.h"

namespace hooke {
namespace {

using Mat32 = Eigen::Matrix<double, 3, 2>;

constexpr double least_curvature = .1;  // of the largest
constexpr double difference = 1e-5;     // step of the differences, in target lengths

/// Two unit vectors that span the plane across the normal. The first leans on an edge, not on a coordinate
/// axis, so that a turned mesh has turned vectors.
Mat32 tangent_basis(const Vec3& normal, const Vec3& edge) {
  Mat32 basis;
  basis.col(0) = (edge - normal * normal.dot(edge)).normalized();
  basis.col(1) = normal.cross(basis.col(0));
  return basis;
}

double improve_vertex(Relaxation& r, int vertex, const LocalNewtonOptions& options) {
  Placement& at = r.placement;
  Vec3 gradient;
  const double energy = r.energy.around(at, vertex, gradient);
  const double length = r.vertex_length[static_cast<size_t>(vertex)];
  Vec3 step = -options.over_relaxation * (local_curvature(r, vertex, gradient).inverse * gradient);
  const double cap = options.max_move * length;
  if (step.norm() > cap) step *= cap / step.norm();
  if (step.isZero(0)) return 0;

  RingMeasures before, after;
  r.guards.measure_ring(at, vertex, before);
  const VertexPlace start(at, vertex);
  for (int halvings = 0; halvings <= options.max_halvings; ++halvings, step *= .5) {
    r.retraction.moved(at, vertex, step).write_to(at, vertex);
    r.guards.measure_ring(at, vertex, after);
    Vec3 unused;
    if (r.guards.ring_obeys(vertex, before, after) && r.energy.around(at, vertex, unused) <= energy)
      return (at.points.col(vertex) - start.point).norm() / length;
    start.write_to(at, vertex);
  }
  return 0;
}

}  // namespace

LocalCurvature local_curvature(const Relaxation& r, int vertex, const Vec3& gradient) {
  const auto neighbours = r.connectivity.vertex_neighbours[vertex];
  if (neighbours.empty()) return {};
  Placement& at = r.placement;
  const Vec3 x = at.points.col(vertex);
  const double h = difference * r.vertex_length[static_cast<size_t>(vertex)];
  const auto change = [&](const Vec3& direction) {
    Vec3 shifted;
    at.points.col(vertex) = x + h * direction;
    r.energy.around(at, vertex, shifted);
    at.points.col(vertex) = x;
    return Vec3((shifted - gradient) / h);
  };
  LocalCurvature c;
  const Vec3 tangent = at.tangents.col(vertex);
  if (!tangent.isZero(0)) {
    c.mean = std::abs(tangent.dot(change(tangent)));
    if (c.mean > 0) c.inverse = tangent * tangent.transpose() / c.mean;
    return c;
  }
  const Vec3 edge = at.points.col(neighbours[0]) - x;
  const Mat32 basis = tangent_basis(at.normals.col(vertex), edge);
  Eigen::Matrix2d hessian;
  for (int k = 0; k < 2; ++k) hessian.col(k) = basis.transpose() * change(basis.col(k));
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(.5 * (hessian + hessian.transpose()));
  const Eigen::Vector2d size = eigen.eigenvalues().cwiseAbs();
  const Eigen::Vector2d curvature = size.cwiseMax(least_curvature * size.maxCoeff());
  c.mean = curvature.mean();
  if (!(c.mean > 0)) return c;
  const Mat32 axes = basis * eigen.eigenvectors();
  c.inverse = axes * curvature.cwiseInverse().asDiagonal() * axes.transpose();
  return c;
}

std::vector<double> local_newton_sweep(Relaxation& r, const std::vector<char>& active,
                                       const LocalNewtonOptions& options) {
  std::vector<double> moves(static_cast<size_t>(r.connectivity.vertex_count), 0);
  for (const std::vector<int>& vertices : r.colours)
    parallel_for(vertices.size(), 64, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) {
        const auto v = static_cast<size_t>(vertices[i]);
        if (active.empty() || active[v]) moves[v] = improve_vertex(r, vertices[i], options);
      }
    });
  r.retraction.count();
  return moves;
}

}  // namespace hooke
