#include "hooke/filter/surface_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "hooke/core/error.h"
#include "hooke/core/parallel.h"
#include "hooke/filter/curved_facets.h"
#include "hooke/filter/partition_of_unity.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/normals.h"
#include "hooke/mesh/surface_point.h"

namespace hooke {

int NearFaces::nearest_vertex(const Vec3& x, int vertex) const {
  double smallest = (points.col(vertex) - x).squaredNorm();
  for (int from = -1; from != vertex;) {
    from = vertex;
    for (const int n : adjacency.vertex_neighbours[from]) {
      const double distance2 = (points.col(n) - x).squaredNorm();
      if (!(distance2 < smallest)) continue;  // ends the walk for NaN too
      smallest = distance2;
      vertex = n;
    }
  }
  return vertex;
}

bool NearFaces::has_face_within(const Vec3& x, int hint, double distance) const {
  return std::ranges::any_of(adjacency.vertex_faces[hint], [&](int f) {
    const Triangle& face = adjacency.faces[f];
    return hooke::closest_point(x, points.col(face[0]), points.col(face[1]), points.col(face[2]))
               .squared_distance <= distance * distance;
  });
}

Projection NearFaces::projection_to(const ClosestPoint& point, const Vec3& x, int hint) const {
  if (point.face < 0) return {x, Vec3::Zero(), hint, ProjectionStatus::no_cover, 0};
  const SurfacePoint place = on_face(point, points, adjacency);
  const Triangle& face = adjacency.faces[place.face];
  Vec3 normal = Vec3::Zero();
  for (int k = 0; k < 3; ++k) normal += place.weights[k] * normals.col(face[k]);
  return {point.point, normal.normalized(), nearest_corner(place, adjacency), ProjectionStatus::converged, 0};
}

Projection NearFaces::closest_point(const Vec3& x, int hint) const {
  return projection_to(closest_point_nearby(points, adjacency, x, hint), x, hint);
}

namespace {

// Deviation bound: splines may overshoot the faces they were fitted to where long faces lie beside short
// ones.

/// Maximum distance of the surface from the faces at each vertex: `max_deviation` times the vertex's length
/// (empty: 1), or infinity where the surface could get that far only by bending_factor several times more
/// than the normals turn along edges. Empty: no limit anywhere.
std::vector<float> deviation_bounds_of(const NearFaces& faces, double max_deviation,
                                       const std::vector<double>& lengths);

/// The projection of x, unless it exceeds the deviation bound of its hint: then the point at that distance
/// from the faces on the same side, above their closest point to x if x is more than half the bound away from
/// them on that side, otherwise above their closest point to the projection.
Projection within_deviation_bound(const NearFaces& faces, const std::vector<float>& deviation_bounds,
                                  const Vec3& x, const Projection& projection);

constexpr float no_limit = std::numeric_limits<float>::infinity();

std::vector<float> deviation_bounds_of(const NearFaces& faces, double max_deviation,
                                       const std::vector<double>& lengths) {
  constexpr double bending_factor = 4;
  const auto& points = faces.points;
  const auto& normals = faces.normals;
  const Adjacency& adjacency = faces.adjacency;
  std::vector<float> deviation_bounds;
  if (max_deviation == std::numeric_limits<double>::infinity()) return deviation_bounds;
  const auto max_deviation_at = [&](int v) {
    return lengths.empty() ? max_deviation : max_deviation * lengths[v];
  };
  std::vector<char> bends_sharply(adjacency.edges.size());
  parallel_for(bends_sharply.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const auto& [a, b] = adjacency.edges[e];
      const double sagitta =
          (normals.col(a) - normals.col(b)).norm() * (points.col(a) - points.col(b)).norm() / 8;
      bends_sharply[e] = bending_factor * sagitta > std::min(max_deviation_at(a), max_deviation_at(b));
    }
  });
  for (std::size_t e = 0; e < bends_sharply.size(); ++e) {
    if (!bends_sharply[e]) continue;
    deviation_bounds.resize(adjacency.vertex_count, no_limit);
    for (int end : adjacency.edges[e]) {
      deviation_bounds[end] = static_cast<float>(max_deviation_at(end));
      for (int v : adjacency.vertex_neighbours[end])
        deviation_bounds[v] = static_cast<float>(max_deviation_at(v));
    }
  }
  return deviation_bounds;
}

Projection within_deviation_bound(const NearFaces& faces, const std::vector<float>& deviation_bounds,
                                  const Vec3& x, const Projection& projection) {
  if (deviation_bounds.empty()) return projection;
  const double max_deviation = deviation_bounds[projection.hint];
  if (max_deviation == no_limit || faces.has_face_within(projection.point, projection.hint, max_deviation))
    return projection;
  Projection nearest = faces.closest_point(projection.point, projection.hint);
  Vec3 height = projection.point - nearest.point;
  if (!(height.squaredNorm() > max_deviation * max_deviation)) return projection;

  const double side = height.dot(nearest.normal) < 0 ? -1 : 1;
  const Projection nearest_to_start = faces.closest_point(x, projection.hint);
  const Vec3 start_height = x - nearest_to_start.point;
  if (side * start_height.dot(nearest_to_start.normal) > 0 && start_height.norm() > .5 * max_deviation) {
    nearest = nearest_to_start;
    height = start_height;
  }
  height.normalize();
  return {nearest.point + max_deviation * height, side * height, nearest.hint, ProjectionStatus::converged,
          projection.evaluations};
}

constexpr double longest_step = .5;  // of Newton's method, in mean edge lengths at the hint
constexpr double longest_move = 2;
constexpr double convergence = 2;  // of Newton's method, over the mean edge length at the hint

/// Vertices of the piece that have faces, one per distinct position.
std::vector<int> distinct_vertices(const Mat3X& points, const Adjacency& adjacency,
                                   const std::vector<int>& pieces, int piece) {
  std::vector<int> vertices;
  for (int v = 0; v < adjacency.vertex_count; ++v)
    if (!adjacency.vertex_faces[v].empty() && (pieces.empty() || pieces[v] == piece)) vertices.push_back(v);
  const auto coordinates = [&](int v) { return std::array{points(0, v), points(1, v), points(2, v)}; };
  std::ranges::stable_sort(vertices, {}, coordinates);
  vertices.erase(std::unique(vertices.begin(), vertices.end(),
                             [&](int a, int b) { return coordinates(a) == coordinates(b); }),
                 vertices.end());
  std::ranges::sort(vertices);
  return vertices;
}

double mean_edge_length(const Mat3X& points, const Adjacency& adjacency) {
  double sum = 0;
  for (const auto& [a, b] : adjacency.edges) sum += (points.col(a) - points.col(b)).norm();
  return adjacency.edges.empty() ? 0 : sum / static_cast<double>(adjacency.edges.size());
}

/// One spline through the vertices [11]-[13], increasing outward; offset values of rho instead of 1 make it a
/// distance.
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
  std::shared_ptr<const Adjacency> adjacency;
  std::shared_ptr<const Mat3X> points;
  Mat3X normals;
  Eigen::VectorXd edge_lengths;
  std::vector<ShapeOperator> shape_operators;
  std::vector<float> deviation_bounds;         // per vertex, see deviation_bounds_of(); empty: no limit
  std::unique_ptr<const CurvedFacets> facets;  // where splines do not follow the mesh; null if they do
  std::optional<PartitionOfUnity> partition;
  std::vector<int> pieces;               // per vertex; empty: one piece
  std::vector<ThinPlateSpline> splines;  // per piece

  NearFaces faces() const { return {*points, normals, *adjacency}; }
  FieldSample sample(const Vec3& x, int hint) const;
  Projection project(const Vec3& x, int hint, double tolerance) const;
  void find_facets();
};

FieldSample SurfaceField::State::sample(const Vec3& x, int hint) const {
  switch (kind) {
    case FilterKind::local:
      return (*partition)(x, hint);
    case FilterKind::global:
      return splines[pieces.empty() ? 0 : pieces[hint]](x);
    case FilterKind::closest: {
      const Projection projection = faces().closest_point(x, hint);
      const double distance = (x - projection.point).norm();
      return {(x - projection.point).dot(projection.normal) < 0 ? -distance : distance, projection.normal};
    }
    case FilterKind::none:
      break;
  }
  return {0, normals.col(hint)};
}

Projection SurfaceField::State::project(const Vec3& x, int hint, double tolerance) const {
  const bool near_facets = facets && facets->is_near(hint);
  const ClosestPoint place = near_facets ? facets->find(x, hint) : ClosestPoint{};
  if (kind == FilterKind::closest) {
    hint = faces().nearest_vertex(x, hint);
    return faces().projection_to(closest_point_nearby(*points, *adjacency, x, hint, place), x, hint);
  }
  if (place.face >= 0 && facets->is_curved(place.face)) return facets->lift(place);
  hint = faces().nearest_vertex(x, hint);
  if (kind == FilterKind::none) return {x, normals.col(hint), hint};

  NewtonOptions newton;
  newton.tolerance = tolerance;
  newton.longest_step = longest_step * edge_lengths[hint];
  newton.longest_move = longest_move * edge_lengths[hint];
  newton.convergence = convergence / edge_lengths[hint];
  const Projection projection =
      project_by_newton([this](const Vec3& p, int a) { return sample(p, a); }, x, hint, newton);
  const bool converged = projection.status == ProjectionStatus::converged;
  if (place.face >= 0 && !(converged && facets->allows(facets->find(projection.point, projection.hint)))) {
    Projection lifted = facets->lift(place);
    lifted.evaluations = projection.evaluations;
    return lifted;
  }
  if (converged) return within_deviation_bound(faces(), deviation_bounds, x, projection);

  Projection fallback = faces().closest_point(x, hint);
  fallback.status = projection.status;
  fallback.evaluations = projection.evaluations;
  return fallback;
}

/// Finds the faces that the splines do not follow, where nothing is known of the shape operators either.
void SurfaceField::State::find_facets() {
  if (kind == FilterKind::closest) {
    facets = CurvedFacets::all_flat(*points, normals, *adjacency);
    return;
  }
  facets = CurvedFacets::where_exceeded(*points, normals, *adjacency, [this](const Vec3& x, int hint) {
    const auto height_tracked_at = [&](int v) {
      const FieldSample s = sample(x, v);
      return s.value / s.gradient.norm();
    };
    // Splines may not reach the point from the vertex that it is projected from.
    const double nearest = height_tracked_at(faces().nearest_vertex(x, hint));
    return std::isnan(nearest) ? nearest : height_tracked_at(hint);
  });
  for (std::size_t v = 0; facets && v < shape_operators.size(); ++v)
    if (facets->is_near(static_cast<int>(v))) shape_operators[v] = unknown_shape_operator();
}

SurfaceField::SurfaceField(std::shared_ptr<const Mat3X> shared_points,
                           std::shared_ptr<const Adjacency> adjacency, const FilterOptions& options,
                           std::vector<int> pieces, const std::vector<double>& lengths) {
  const Mat3X& points = *shared_points;
  auto state = std::make_shared<State>();
  state->kind = options.kind;
  state->normals = vertex_normals(points, *adjacency);
  state->edge_lengths = mean_edge_lengths(points, *adjacency);
  if (options.kind == FilterKind::local || options.kind == FilterKind::global) {
    state->shape_operators = shape_operators(points, state->normals, *adjacency);
    state->deviation_bounds =
        deviation_bounds_of({points, state->normals, *adjacency}, options.max_deviation, lengths);
  }
  if (options.kind == FilterKind::local)
    state->partition.emplace(points, *adjacency, state->normals, state->edge_lengths,
                             PartitionOptions{.kernel = options.kernel, .offset = options.offset});
  if (options.kind == FilterKind::global) {
    const double unit = options.offset_unit == OffsetUnit::edge ? mean_edge_length(points, *adjacency) : 1.;
    const double rho = (options.inward ? -1 : 1) * options.offset * unit;
    const int count = pieces.empty() ? 1 : 1 + *std::ranges::max_element(pieces);
    for (int piece = 0; piece < count; ++piece)
      state->splines.push_back(fit_global_spline(points, distinct_vertices(points, *adjacency, pieces, piece),
                                                 state->normals, rho, options));
    state->pieces = std::move(pieces);
  }
  state->points = std::move(shared_points);
  state->adjacency = std::move(adjacency);
  if (options.facets && options.kind != FilterKind::none) state->find_facets();
  state_ = std::move(state);
}

Projection SurfaceField::project(const Vec3& x, int hint, double tolerance) const {
  return state_->project(x, hint, tolerance);
}

FieldSample SurfaceField::sample(const Vec3& x, int hint) const {
  return state_->sample(x, hint);
}

Surface SurfaceField::surface() const {
  const auto project = [state = state_](const Vec3& x, int hint, double tolerance) {
    return state->project(x, hint, tolerance);
  };
  const auto shape_operator_at = [state = state_](int hint) {
    if (state->shape_operators.empty()) return unknown_shape_operator();
    return state->shape_operators[hint];
  };
  return {project, shape_operator_at};
}

const Mat3X& SurfaceField::points() const {
  return *state_->points;
}
const Mat3X& SurfaceField::normals() const {
  return state_->normals;
}

std::size_t SurfaceField::memory_bytes() const {
  const auto doubles = state_->points->size() + state_->normals.size() + state_->edge_lengths.size();
  return sizeof(double) * static_cast<std::size_t>(doubles) +
         sizeof(ShapeOperator) * state_->shape_operators.capacity() +
         sizeof(float) * state_->deviation_bounds.capacity() +
         (state_->facets ? state_->facets->memory_bytes() : 0) +
         (state_->partition ? state_->partition->memory_bytes() : 0) +
         std::transform_reduce(state_->splines.begin(), state_->splines.end(), std::size_t{0}, std::plus<>(),
                               [](const ThinPlateSpline& s) { return s.memory_bytes(); });
}

}  // namespace hooke
