#include "hooke/filter/surface_field.h"

#include <algorithm>
#include <numeric>

#include "hooke/core/error.h"
#include "hooke/core/parallel.h"
#include "hooke/filter/field_reach.h"
#include "hooke/filter/near_faces.h"
#include "hooke/filter/partition_of_unity.h"
#include "hooke/filter/projection.h"
#include "hooke/mesh/normals.h"

namespace hooke {
namespace {

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
