#include "hooke/integrator/gauss_seidel.h"

#include <algorithm>
#include <cmath>

#include "hooke/core/parallel.h"
#include "hooke/filter/retraction.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/vertex_coloring.h"
#include "hooke/springs/energy.h"

namespace hooke {
namespace {

constexpr double min_curvature = .1;  // of the largest eigenvalue

/// Two orthonormal vectors that span the plane across the normal. The first follows an edge instead of a
/// coordinate axis, so that the basis rotates with the mesh.
Mat32 tangent_basis(const Vec3& normal, const Vec3& edge) {
  Mat32 basis;
  basis.col(0) = (edge - normal * normal.dot(edge)).normalized();
  basis.col(1) = normal.cross(basis.col(0));
  return basis;
}

/// |H|^-1 and the mean of its eigenvalues, for symmetric H, from the eigenprojections (1 +- (H - m) / r) / 2.
double invert_by_size(const Eigen::Matrix2d& H, Eigen::Matrix2d& inverse) {
  const double m = .5 * (H(0, 0) + H(1, 1));
  const double d = .5 * (H(0, 0) - H(1, 1));
  const double r = std::sqrt(d * d + H(0, 1) * H(0, 1));
  const double largest = std::abs(m) + r;
  if (!(largest > 0)) return 0;
  const double high = std::max(std::abs(m + r), min_curvature * largest);
  const double low = std::max(std::abs(m - r), min_curvature * largest);
  const Eigen::Matrix2d unit = Eigen::Matrix2d::Identity();
  inverse = .5 * (1 / high + 1 / low) * unit;
  if (r > 0) inverse += .5 * (1 / high - 1 / low) / r * (H - m * unit);
  return .5 * (high + low);
}

LocalCurvature curvature_of(const RingModel& model, const Mat32& basis) {
  LocalCurvature c;
  if (basis.col(1).isZero(0)) {  // slides along a curve
    c.mean = std::abs(model.hessian(0, 0));
    if (c.mean > 0) c.inverse = basis.col(0) * basis.col(0).transpose() / c.mean;
    return c;
  }
  Eigen::Matrix2d inverse = Eigen::Matrix2d::Zero();
  c.mean = invert_by_size(model.hessian, inverse);
  c.inverse = basis * inverse * basis.transpose();
  return c;
}

}  // namespace

LocalNewton::LocalNewton(Relaxation& relaxation)
    : r_(relaxation),
      wedge_{VertexRing(relaxation.coloring.rings, relaxation.energy.targets()), {}, {}},
      other_wedge_(wedge_) {}

Mat32 LocalNewton::directions(int vertex) const {
  const SurfacePositions& at = r_.positions;
  Mat32 curve = Mat32::Zero();
  curve.col(0) = r_.retraction.tangent(at, vertex);
  if (!curve.col(0).isZero(0)) return curve;
  const int neighbour = r_.coloring.rings[vertex][0].neighbour;
  return tangent_basis(at.normals.col(vertex), at.points.col(neighbour) - at.points.col(vertex));
}

/// Gathers the ring of a vertex and the model of its energy; false for a vertex that cannot move.
bool LocalNewton::gather(int vertex) {
  const SurfacePositions& at = r_.positions;
  if (r_.coloring.rings[vertex].empty() || r_.retraction.stands_still(vertex)) return false;
  basis_ = directions(vertex);
  const auto model = [&](Wedge& s, int wedge) {
    s.ring.gather(at, wedge);
    s.ring.shape(at.points.col(vertex), at.normals.col(wedge), s.before);
    return s.ring.model(s.before, r_.terms, basis_.col(0), basis_.col(1));
  };
  model_ = model(wedge_, vertex);
  const int other = at.other_wedge_of(vertex);
  two_wedges_ = other >= 0;
  if (!two_wedges_) return true;
  const RingModel more = model(other_wedge_, other);
  model_.energy += more.energy;
  model_.gradient += more.gradient;
  model_.hessian += more.hessian;
  return true;
}

/// An unfolded face is subject to the springs of all others, which cost more than unfolding gains: a step
/// that unfolds a face need not lower the energy.
bool LocalNewton::may_move(const SurfacePosition& candidate) {
  double energy = 0;
  int unfolded = 0;
  const RingTerms& terms = r_.terms;
  const auto obeys = [&](Wedge& s, const Vec3& normal) {
    s.ring.shape(candidate.point, normal, s.after);
    if (!s.ring.obeys(s.before, s.after, r_.guards.limits())) return false;
    energy += s.ring.energy(s.after, terms);
    if (terms.unfold > 0)
      unfolded += s.ring.folded_faces(s.before, terms.unfold_below) -
                  s.ring.folded_faces(s.after, terms.unfold_below);
    return true;
  };
  return obeys(wedge_, candidate.normal) && (!two_wedges_ || obeys(other_wedge_, candidate.other_normal)) &&
         (unfolded > 0 || energy <= model_.energy);
}

LocalCurvature LocalNewton::curvature(int vertex) {
  return gather(vertex) ? curvature_of(model_, basis_) : LocalCurvature{};
}

double LocalNewton::improve(int vertex, const LocalNewtonOptions& options) {
  if (!gather(vertex)) return 0;
  SurfacePositions& at = r_.positions;
  const double length = r_.vertex_length[vertex];
  Vec3 step = -options.over_relaxation * (curvature_of(model_, basis_).inverse * (basis_ * model_.gradient));
  const double size = step.norm(), cap = options.max_move * length;
  if (!(size > options.rest * length)) return 0;
  if (size > cap) step *= cap / size;

  for (int halvings = 0; halvings <= options.max_halvings; ++halvings, step *= .5) {
    const SurfacePosition candidate = r_.retraction.moved(at, vertex, step);
    if (may_move(candidate)) {
      const double distance = (candidate.point - at.points.col(vertex)).norm();
      candidate.write_to(at, vertex);
      return distance / length;
    }
  }
  return 0;
}

std::vector<double> local_newton_sweep(Relaxation& r, const std::vector<char>& active,
                                       const LocalNewtonOptions& options) {
  std::vector<double> moves(r.adjacency.vertex_count, 0);
  for_each_block(r.coloring, [&](int begin, int end) {
    LocalNewton newton(r);
    for (int v = begin; v < end; ++v)
      if (active.empty() || active[v]) moves[v] = newton.improve(v, options);
  });
  r.retraction.count();
  return moves;
}

namespace {

constexpr double min_step_factor = .3;  // of `rest`: a vertex with a shorter step is not moved at all

/// Marks as active the vertices that moved and their neighbours.
void mark_active(const Adjacency& c, const std::vector<int>& vertices, const std::vector<char>& moved,
                 std::vector<char>& active) {
  const auto has_moved = [&](int v) { return moved[v] != 0; };
  parallel_for(vertices.size(), 1024, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const int v = vertices[i];
      active[v] = has_moved(v) || std::ranges::any_of(c.vertex_neighbours[v], has_moved);
    }
  });
}

}  // namespace

/// By default the steps are not over-relaxed: where guards limit vertices and springs end, longer steps
/// magnify rounding, and a translated or rotated mesh would get another result.
LocalRelaxationResult relax_locally(Relaxation& r, std::vector<int> vertices, const LocalRelaxationOptions& o,
                                    const Observer& observer) {
  const LocalNewtonOptions newton{.over_relaxation = o.over_relaxation, .rest = min_step_factor * o.rest};
  LocalRelaxationResult result;
  std::ranges::sort(vertices);
  std::vector<char> active(r.adjacency.vertex_count, 1), moved(r.adjacency.vertex_count, 0);
  bool any_moved = !vertices.empty();
  while (any_moved && result.sweeps < o.sweeps && !result.interrupted) {
    for_each_of(
        r.coloring, vertices, [&] { return LocalNewton(r); },
        [&](LocalNewton& local, size_t i) {
          const int v = vertices[i];
          moved[v] = active[v] && local.improve(v, newton) > o.rest;
        });
    r.retraction.count();
    mark_active(r.adjacency, vertices, moved, active);
    const auto moves = std::ranges::count_if(vertices, [&](int v) { return moved[v] != 0; });
    result.moves += static_cast<int>(moves);
    any_moved = moves > 0;
    result.interrupted = observer && !observer({.step = result.sweeps});
    ++result.sweeps;
  }
  return result;
}

}  // namespace hooke
