#include "hooke/integrator/gauss_seidel.h"

#include <algorithm>
#include <cmath>

#include "hooke/constraints/junction_curves.h"
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
      wedges_(2, {VertexRing(relaxation.coloring.rings, relaxation.energy.targets()), {}, {}}) {}

Mat32 LocalNewton::directions(int vertex) const {
  const SurfacePositions& at = r_.positions;
  Mat32 curve = Mat32::Zero();
  curve.col(0) = r_.retraction.tangent(at, vertex);
  if (!curve.col(0).isZero(0)) return curve;
  const int neighbour = r_.coloring.rings[vertex][0].neighbour;
  return tangent_basis(at.normals.col(vertex), at.points.col(neighbour) - at.points.col(vertex));
}

bool LocalNewton::stays(int vertex) const {
  return r_.coloring.rings[vertex].empty() || r_.retraction.stands_still(vertex);
}

/// Gathers the rings of a vertex, or of copies of one, and the model of their energy.
void LocalNewton::gather(std::span<const int> copies) {
  const SurfacePositions& at = r_.positions;
  basis_ = directions(copies.front());
  count_ = 0;
  const auto add = [&](int vertex, int wedge) {
    if (count_ == wedges_.size()) wedges_.push_back(wedges_.front());
    Wedge& s = wedges_[count_++];
    s.ring.gather(at, wedge);
    s.ring.shape(at.points.col(vertex), at.normals.col(wedge), s.before);
    const RingModel model = s.ring.model(s.before, r_.terms, basis_.col(0), basis_.col(1));
    if (count_ == 1) {
      model_ = model;
      return;
    }
    model_.energy += model.energy;
    model_.gradient += model.gradient;
    model_.hessian += model.hessian;
  };
  for (const int v : copies) {
    add(v, v);
    if (const int other = at.other_wedge_of(v); other >= 0) add(v, other);
  }
}

/// An unfolded face is subject to the springs of all others, which cost more than unfolding gains: a step
/// that unfolds a face need not lower the energy.
bool LocalNewton::may_move(std::span<const SurfacePosition> candidates) {
  double energy = 0;
  int unfolded = 0;
  const RingTerms& terms = r_.terms;
  std::size_t next = 0;
  const auto obeys = [&](const Vec3& point, const Vec3& normal) {
    Wedge& s = wedges_[next++];
    s.ring.shape(point, normal, s.after);
    if (!s.ring.obeys(s.before, s.after, r_.guards.limits())) return false;
    energy += s.ring.energy(s.after, terms);
    if (terms.unfold > 0)
      unfolded += s.ring.folded_faces(s.before, terms.unfold_below) -
                  s.ring.folded_faces(s.after, terms.unfold_below);
    return true;
  };
  for (const SurfacePosition& c : candidates)
    if (!obeys(c.point, c.normal) || (c.other_wedge >= 0 && !obeys(c.point, c.other_normal))) return false;
  return unfolded > 0 || energy <= model_.energy;
}

LocalCurvature LocalNewton::curvature(int vertex) {
  if (stays(vertex)) return {};
  gather({&vertex, 1});
  return curvature_of(model_, basis_);
}

LocalCurvature LocalNewton::curvature(std::span<const int> copies) {
  gather(copies);
  LocalCurvature c = curvature_of(model_, basis_);
  const auto count = static_cast<double>(copies.size());
  c.inverse *= count;
  c.mean /= count;
  return c;
}

double LocalNewton::improve(int vertex, const LocalNewtonOptions& options) {
  was_refused_ = false;
  return stays(vertex) ? 0 : improve({&vertex, 1}, options);
}

double LocalNewton::improve(std::span<const int> copies, const LocalNewtonOptions& options) {
  gather(copies);
  const int first = copies.front();
  const bool slides = r_.retraction.stands_still(first);  // by itself
  SurfacePositions& at = r_.positions;
  const double length = r_.vertex_length[first];
  Vec3 step = -options.over_relaxation * (curvature_of(model_, basis_).inverse * (basis_ * model_.gradient));
  const double size = step.norm(), cap = options.max_move * length;
  was_refused_ = size > options.rest * length;
  if (!was_refused_) return 0;
  if (size > cap) step *= cap / size;

  for (int halvings = 0; halvings <= options.max_halvings; ++halvings, step *= .5) {
    if (options.skips_middle_steps && halvings > 0 && halvings < options.max_halvings) continue;
    candidates_.clear();
    for (const int v : copies)
      candidates_.push_back(slides ? r_.retraction.slid(at, v, first, step)
                                   : r_.retraction.moved(at, v, step));
    if (!may_move(candidates_)) continue;
    const double distance = (candidates_.front().point - at.points.col(first)).norm();
    for (std::size_t i = 0; i < copies.size(); ++i) candidates_[i].write_to(at, copies[i]);
    was_refused_ = false;
    return distance / length;
  }
  return 0;
}

namespace {

/// Moves the vertices of junctions that slide with their copies, if one of these is active (empty: all are),
/// and calls moved(v, distance) for each copy. Serial, as copies of a vertex may be anywhere.
void slide_junctions(Relaxation& r, const std::vector<char>& active, const LocalNewtonOptions& options,
                     const auto& moved) {
  LocalNewton newton(r);
  for_each_sliding(r.retraction.constraints(), [&](std::span<const int> copies) {
    const bool is_active =
        active.empty() || std::ranges::any_of(copies, [&](int v) { return active[v] != 0; });
    const double distance = is_active ? newton.improve(copies, options) : 0;
    for (const int v : copies) moved(v, distance);
  });
}

}  // namespace

std::vector<double> local_newton_sweep(Relaxation& r, const std::vector<char>& active,
                                       const LocalNewtonOptions& options) {
  std::vector<double> moves(r.adjacency.vertex_count, 0);
  for_each_block(r.coloring, [&](int begin, int end) {
    LocalNewton newton(r);
    for (int v = begin; v < end; ++v)
      if (active.empty() || active[v]) moves[v] = newton.improve(v, options);
  });
  slide_junctions(r, active, options, [&](int v, double distance) { moves[v] = distance; });
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
  const std::vector<char> none(r.adjacency.vertex_count, 0);
  std::vector<char> active = none, moved = none, refused = none;
  for (int v : vertices) active[v] = 1;
  bool any_moved = !vertices.empty();
  while (any_moved && result.sweeps < o.sweeps && !result.interrupted) {
    for_each_of(
        r.coloring, vertices, [&] { return LocalNewton(r); },
        [&](LocalNewton& local, size_t i) {
          const int v = vertices[i];
          moved[v] = 0;
          if (!active[v]) return;
          LocalNewtonOptions options = newton;
          options.skips_middle_steps = refused[v];  // what was refused mostly is again
          moved[v] = local.improve(v, options) > o.rest;
          refused[v] = local.was_refused();
        });
    if (o.slides_copies)
      slide_junctions(r, active, newton, [&](int v, double distance) { moved[v] = distance > o.rest; });
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
