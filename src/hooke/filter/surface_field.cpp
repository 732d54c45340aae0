#include "hooke/filter/surface_field.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "hooke/core/error.h"
#include "hooke/core/parallel.h"
#include "hooke/filter/newton_projection.h"
#include "hooke/filter/partition_of_unity.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/normals.h"

namespace hooke {
namespace {

/// From x to the box about the corners, which no point of the face is closer than.
double squared_distance_to_box(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& x) {
  const Vec3 lower = a.cwiseMin(b).cwiseMin(c), upper = a.cwiseMax(b).cwiseMax(c);
  return (lower - x).cwiseMax(x - upper).cwiseMax(0).squaredNorm();
}

}  // namespace

int NearFaces::nearest_vertex(const Vec3& x, int vertex) const {
  double least = (points.col(vertex) - x).squaredNorm();
  for (int from = -1; from != vertex;) {
    from = vertex;
    for (int n : connectivity.vertex_neighbours[from]) {
      const double distance2 = (points.col(n) - x).squaredNorm();
      if (!(distance2 < least)) continue;  // ends the walk for NaN too
      least = distance2;
      vertex = n;
    }
  }
  return vertex;
}

Foot NearFaces::closest_point_of_ring(const Vec3& x, int anchor) const {
  Foot foot{x, Vec3::Zero(), anchor, FootStatus::no_cover, 0};
  double least = std::numeric_limits<double>::infinity();
  const auto visit = [&](int v) {
    for (int f : connectivity.vertex_faces[v]) {
      const Triangle& face = connectivity.faces[static_cast<std::size_t>(f)];
      if (v != anchor && std::ranges::find(face, anchor) != face.end()) continue;  // seen with the anchor
      const Vec3 a = points.col(face[0]), b = points.col(face[1]), c = points.col(face[2]);
      if (squared_distance_to_box(a, b, c, x) >= least) continue;
      const TrianglePoint near = closest_point_on_triangle(a, b, c, x);
      if (near.squared_distance >= least) continue;
      least = near.squared_distance;
      foot.point = near.point;
      foot.normal.setZero();
      for (int k = 0; k < 3; ++k)
        foot.normal += near.weights[k] * normals.col(face[static_cast<std::size_t>(k)]);
      Eigen::Index corner;
      near.weights.maxCoeff(&corner);
      foot.anchor = face[static_cast<std::size_t>(corner)];
      foot.status = FootStatus::converged;
    }
  };
  visit(anchor);
  for (int n : connectivity.vertex_neighbours[anchor]) visit(n);
  foot.normal.normalize();
  return foot;
}

bool NearFaces::has_face_within(const Vec3& x, int anchor, double distance) const {
  return std::ranges::any_of(connectivity.vertex_faces[anchor], [&](int f) {
    const Triangle& face = connectivity.faces[static_cast<std::size_t>(f)];
    return closest_point_on_triangle(points.col(face[0]), points.col(face[1]), points.col(face[2]), x)
               .squared_distance <= distance * distance;
  });
}

Foot NearFaces::closest_point(const Vec3& x, int anchor) const {
  Foot foot = closest_point_of_ring(x, anchor);
  while (foot.anchor != anchor) {
    anchor = foot.anchor;
    const Foot next = closest_point_of_ring(x, anchor);
    if (!((next.point - x).squaredNorm() < (foot.point - x).squaredNorm())) break;
    foot = next;
  }
  return foot;
}

namespace {

// A bound on how far a fitted surface may swing out from the faces it was fitted to: splines do where long
// faces lie beside short ones.

/// How far the surface may be from the faces about each vertex: `reach` times the vertex's length (empty: 1),
/// and infinity where it could only come that far by bending several times more than the normals turn along
/// edges. Empty: no limit anywhere.
std::vector<float> reaches_of(const NearFaces& faces, double reach, const std::vector<double>& lengths);

/// The foot of x, unless it is beyond its anchor's reach: then a place on the same side at that distance from
/// the faces, above their point next to x when x is more than half as far from them, else above that next to
/// the foot.
Foot within_reach(const NearFaces& faces, const std::vector<float>& reaches, const Vec3& x, const Foot& foot);

constexpr float no_limit = std::numeric_limits<float>::infinity();

std::vector<float> reaches_of(const NearFaces& faces, double reach, const std::vector<double>& lengths) {
  constexpr double bending = 4;
  const auto& [points, normals, connectivity] = faces;
  std::vector<float> reaches;
  if (reach == std::numeric_limits<double>::infinity()) return reaches;
  const auto most = [&](int v) {
    return lengths.empty() ? reach : reach * lengths[static_cast<std::size_t>(v)];
  };
  std::vector<char> bends(connectivity.edges.size());
  parallel_for(bends.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const auto& [a, b] = connectivity.edges[e];
      const double sagitta =
          (normals.col(a) - normals.col(b)).norm() * (points.col(a) - points.col(b)).norm() / 8;
      bends[e] = bending * sagitta > std::min(most(a), most(b));
    }
  });
  for (std::size_t e = 0; e < bends.size(); ++e) {
    if (!bends[e]) continue;
    reaches.resize(static_cast<std::size_t>(connectivity.vertex_count), no_limit);
    for (int end : connectivity.edges[e]) {
      reaches[static_cast<std::size_t>(end)] = static_cast<float>(most(end));
      for (int v : connectivity.vertex_neighbours[end])
        reaches[static_cast<std::size_t>(v)] = static_cast<float>(most(v));
    }
  }
  return reaches;
}

Foot within_reach(const NearFaces& faces, const std::vector<float>& reaches, const Vec3& x,
                  const Foot& foot) {
  if (reaches.empty()) return foot;
  const double reach = reaches[static_cast<std::size_t>(foot.anchor)];
  if (reach == no_limit || faces.has_face_within(foot.point, foot.anchor, reach)) return foot;
  Foot below = faces.closest_point(foot.point, foot.anchor);
  Vec3 height = foot.point - below.point;
  if (!(height.squaredNorm() > reach * reach)) return foot;

  const double side = height.dot(below.normal) < 0 ? -1 : 1;
  const Foot below_start = faces.closest_point(x, foot.anchor);
  const Vec3 start_height = x - below_start.point;
  if (side * start_height.dot(below_start.normal) > 0 && start_height.norm() > .5 * reach) {
    below = below_start;
    height = start_height;
  }
  height.normalize();
  return {below.point + reach * height, side * height, below.anchor, FootStatus::converged, foot.evaluations};
}

constexpr double longest_step = .5;  // of Newton, in mean edge lengths at the anchor
constexpr double longest_move = 2;
constexpr double convergence = 2;  // of Newton's method, over the mean edge length at the anchor

/// Vertices of the piece that have faces, without the repetitions of one place.
std::vector<int> distinct_vertices(const Mat3X& points, const Connectivity& connectivity,
                                   const std::vector<int>& pieces, int piece) {
  std::vector<int> vertices;
  for (int v = 0; v < connectivity.vertex_count; ++v)
    if (!connectivity.vertex_faces[v].empty() &&
        (pieces.empty() || pieces[static_cast<std::size_t>(v)] == piece))
      vertices.push_back(v);
  const auto place = [&](int v) { return std::array{points(0, v), points(1, v), points(2, v)}; };
  std::ranges::stable_sort(vertices, {}, place);
  vertices.erase(
      std::unique(vertices.begin(), vertices.end(), [&](int a, int b) { return place(a) == place(b); }),
      vertices.end());
  std::ranges::sort(vertices);
  return vertices;
}

double mean_edge_length(const Mat3X& points, const Connectivity& connectivity) {
  double sum = 0;
  for (const auto& [a, b] : connectivity.edges) sum += (points.col(a) - points.col(b)).norm();
  return connectivity.edges.empty() ? 0 : sum / static_cast<double>(connectivity.edges.size());
}

/// One spline through the vertices [11]-[13], grown outward; the value rho instead of 1 makes it a distance.
ThinPlateSpline fit_global_spline(const Mat3X& points, const std::vector<int>& vertices, const Mat3X& normals,
                                  double rho, const FilterOptions& options) {
  Mat3X centres(3, 2 * static_cast<Eigen::Index>(vertices.size()));
  Eigen::VectorXd values(centres.cols());
  Eigen::Index count = 0;
  for (int v : vertices) {
    centres.col(count) = points.col(v);
    values[count++] = 0;
    if (normals.col(v).isZero(0)) continue;
    centres.col(count) = points.col(v) + rho * normals.col(v);
    values[count++] = rho;
  }
  auto spline = ThinPlateSpline::fit(centres.leftCols(count), values.head(count), options.kernel, 1,
                                     options.memory_limit_bytes);
  if (!spline)
    throw NumericalError(
        "the spline through all vertices has no solution; vertices at distinct places were expected; use the "
        "local filter");
  return *std::move(spline);
}

}  // namespace

struct SurfaceField::State {
  FilterKind kind;
  std::shared_ptr<const Connectivity> connectivity;
  std::shared_ptr<const Mat3X> points;
  Mat3X normals;
  Eigen::VectorXd edge_lengths;
  std::vector<SurfaceBend> bends;
  std::vector<float> reaches;  // see field_reach.h
  std::optional<PartitionOfUnity> partition;
  std::vector<int> pieces;               // per vertex; empty: one
  std::vector<ThinPlateSpline> splines;  // per piece

  NearFaces faces() const { return {*points, normals, *connectivity}; }
  FieldSample sample(const Vec3& x, int anchor) const;
  Foot project(const Vec3& x, int anchor, double tolerance) const;
};

FieldSample SurfaceField::State::sample(const Vec3& x, int anchor) const {
  switch (kind) {
    case FilterKind::local:
      return (*partition)(x, anchor);
    case FilterKind::global:
      return splines[pieces.empty() ? 0 : static_cast<std::size_t>(pieces[static_cast<std::size_t>(anchor)])](
          x);
    case FilterKind::closest: {
      const Foot foot = faces().closest_point(x, anchor);
      const double distance = (x - foot.point).norm();
      return {(x - foot.point).dot(foot.normal) < 0 ? -distance : distance, foot.normal};
    }
    case FilterKind::none:
      break;
  }
  return {0, normals.col(anchor)};
}

Foot SurfaceField::State::project(const Vec3& x, int anchor, double tolerance) const {
  anchor = faces().nearest_vertex(x, anchor);
  if (kind == FilterKind::none) return {x, normals.col(anchor), anchor};
  if (kind == FilterKind::closest) return faces().closest_point(x, anchor);

  NewtonOptions newton;
  newton.tolerance = tolerance;
  newton.longest_step = longest_step * edge_lengths[anchor];
  newton.longest_move = longest_move * edge_lengths[anchor];
  newton.convergence = convergence / edge_lengths[anchor];
  const Foot foot =
      project_by_newton([this](const Vec3& p, int a) { return sample(p, a); }, x, anchor, newton);
  if (foot.status == FootStatus::converged) return within_reach(faces(), reaches, x, foot);

  Foot fallback = faces().closest_point(x, anchor);
  fallback.status = foot.status;
  fallback.evaluations = foot.evaluations;
  return fallback;
}

SurfaceField::SurfaceField(std::shared_ptr<const Mat3X> shared_points,
                           std::shared_ptr<const Connectivity> connectivity, const FilterOptions& options,
                           std::vector<int> pieces, const std::vector<double>& lengths) {
  const Mat3X& points = *shared_points;
  auto state = std::make_shared<State>();
  state->kind = options.kind;
  state->normals = vertex_normals(points, *connectivity);
  state->edge_lengths = mean_edge_lengths(points, *connectivity);
  if (options.kind == FilterKind::local || options.kind == FilterKind::global) {
    state->bends = surface_bends(points, state->normals, *connectivity);
    state->reaches = reaches_of({points, state->normals, *connectivity}, options.reach, lengths);
  }
  if (options.kind == FilterKind::local)
    state->partition.emplace(points, *connectivity, state->normals, state->edge_lengths,
                             PartitionOptions{.kernel = options.kernel, .offset = options.offset});
  if (options.kind == FilterKind::global) {
    const double rho = options.offset * mean_edge_length(points, *connectivity);
    const int count = pieces.empty() ? 1 : 1 + *std::ranges::max_element(pieces);
    for (int piece = 0; piece < count; ++piece)
      state->splines.push_back(fit_global_spline(
          points, distinct_vertices(points, *connectivity, pieces, piece), state->normals, rho, options));
    state->pieces = std::move(pieces);
  }
  state->points = std::move(shared_points);
  state->connectivity = std::move(connectivity);
  state_ = std::move(state);
}

Foot SurfaceField::project(const Vec3& x, int anchor, double tolerance) const {
  return state_->project(x, anchor, tolerance);
}

FieldSample SurfaceField::sample(const Vec3& x, int anchor) const {
  return state_->sample(x, anchor);
}

Surface SurfaceField::surface() const {
  const auto project = [state = state_](const Vec3& x, int anchor, double tolerance) {
    return state->project(x, anchor, tolerance);
  };
  const auto bend = [state = state_](int anchor) {
    if (state->bends.empty()) return unknown_bend();
    return state->bends[static_cast<std::size_t>(anchor)];
  };
  return {project, bend};
}

const Mat3X& SurfaceField::points() const {
  return *state_->points;
}
const Mat3X& SurfaceField::normals() const {
  return state_->normals;
}

std::size_t SurfaceField::memory_bytes() const {
  const auto doubles = state_->points->size() + state_->normals.size() + state_->edge_lengths.size();
  return sizeof(double) * static_cast<std::size_t>(doubles) + sizeof(SurfaceBend) * state_->bends.capacity() +
         sizeof(float) * state_->reaches.capacity() +
         (state_->partition ? state_->partition->memory_bytes() : 0) +
         std::transform_reduce(state_->splines.begin(), state_->splines.end(), std::size_t{0}, std::plus<>(),
                               [](const ThinPlateSpline& s) { return s.memory_bytes(); });
}

}  // namespace hooke
