#include "hooke/local_newton.h"

#include <Eigen/Eigenvalues>

#include "hooke/parallel.h"

namespace hooke {
namespace {

using Mat32 = Eigen::Matrix<double, 3, 2>;

/// Two unit vectors that span the plane across the normal.
Mat32 tangent_basis(const Vec3& normal) {
  Mat32 basis;
  Eigen::Index axis;
  normal.cwiseAbs().minCoeff(&axis);
  basis.col(0) = normal.cross(Vec3::Unit(axis)).normalized();
  basis.col(1) = normal.cross(basis.col(0));
  return basis;
}

/// -|H|^-1 g with the Hessian by differences of the gradient; curvature below a part of the largest is raised
/// to it, so that the step descends from saddles too.
Vec3 newton_step(const Energy& energy, Placement& at, int vertex, const Mat32& basis, const Vec3& gradient,
                 double length) {
  const double h = 1e-5 * length;
  const Vec3 x = at.points.col(vertex);
  Eigen::Matrix2d hessian;
  for (int k = 0; k < 2; ++k) {
    Vec3 shifted;
    at.points.col(vertex) = x + h * basis.col(k);
    energy.around(at, vertex, shifted);
    hessian.col(k) = basis.transpose() * (shifted - gradient) / h;
  }
  at.points.col(vertex) = x;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(.5 * (hessian + hessian.transpose()));
  const Eigen::Vector2d size = eigen.eigenvalues().cwiseAbs();
  const Eigen::Vector2d curvature = size.cwiseMax(.1 * size.maxCoeff() + 1e-12);
  const Eigen::Vector2d g = eigen.eigenvectors().transpose() * (basis.transpose() * gradient);
  return -basis * (eigen.eigenvectors() * g.cwiseQuotient(curvature));
}

double improve_vertex(Relaxation& r, int vertex, const LocalNewtonOptions& options) {
  Placement& at = r.placement;
  Vec3 gradient;
  const double energy = r.energy.around(at, vertex, gradient);
  const double length = r.vertex_length[static_cast<size_t>(vertex)];
  const Vec3 normal = at.normals.col(vertex);
  Vec3 step =
      options.over_relaxation * newton_step(r.energy, at, vertex, tangent_basis(normal), gradient, length);
  if (!at.tangents.col(vertex).isZero(0)) {
    const Vec3 tangent = at.tangents.col(vertex);
    step = tangent * tangent.dot(step);
  }
  const double cap = options.max_move * length;
  if (step.norm() > cap) step *= cap / step.norm();
  if (!step.allFinite() || step.isZero(0)) return 0;

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

std::vector<std::vector<int>> colour_vertices(const Connectivity& c) {
  std::vector<int> colour(static_cast<size_t>(c.vertex_count), -1);
  std::vector<std::vector<int>> classes;
  std::vector<bool> used;
  for (int v = 0; v < c.vertex_count; ++v) {
    used.assign(classes.size() + 1, false);
    for (int w : c.vertex_neighbours[v])
      if (colour[static_cast<size_t>(w)] >= 0)
        used[static_cast<size_t>(colour[static_cast<size_t>(w)])] = true;
    size_t first = 0;
    while (used[first]) ++first;
    if (first == classes.size()) classes.emplace_back();
    classes[first].push_back(v);
    colour[static_cast<size_t>(v)] = static_cast<int>(first);
  }
  return classes;
}

double local_newton_sweep(Relaxation& r, const std::vector<std::vector<int>>& colours,
                          const std::vector<char>& active, const LocalNewtonOptions& options) {
  std::vector<double> moves(static_cast<size_t>(r.connectivity.vertex_count), 0);
  for (const std::vector<int>& vertices : colours)
    parallel_for(vertices.size(), 64, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) {
        const auto v = static_cast<size_t>(vertices[i]);
        if (active.empty() || active[v]) moves[v] = improve_vertex(r, vertices[i], options);
      }
    });
  r.retraction.count();
  return moves.empty() ? 0 : *std::max_element(moves.begin(), moves.end());
}

}  // namespace hooke
