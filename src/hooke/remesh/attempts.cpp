#include "hooke/remesh/attempts.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "hooke/constraints/crease_detection.h"
#include "hooke/core/error.h"
#include "hooke/core/stopwatch.h"
#include "hooke/measure/polygon_angles.h"
#include "hooke/mesh/image_surfaces.h"
#include "hooke/mesh/junctions.h"
#include "hooke/mesh/mesh.h"
#include "hooke/mesh/normals.h"
#include "hooke/mesh/sagitta.h"
#include "hooke/mesh/surface_point.h"
#include "hooke/remesh/remesh.h"
#include "hooke/remesh/run.h"
#include "hooke/remesh/run_options.h"
#include "hooke/remesh/shells.h"
#include "hooke/springs/sizing.h"
#include "hooke/springs/target_lengths.h"

namespace hooke {
namespace {

constexpr double angle_rounding = 1e-9;  // relative

Quality measure(const MeasuredSurface& surface, const TriMesh& mesh, const Permutation& order,
                Stopwatch* stopwatch) {
  return measure_quality(surface, target_lengths_of(mesh, order, surface.adjacency).edge, {}, stopwatch);
}

double deviation_of(const TriMesh& mesh, const IntLists& polygons) {
  const std::optional<PolygonAngles> angles = measure_polygon_angles(vertex_points(mesh), polygons);
  return angles ? angles->rms_deviation : 0;
}

}  // namespace

std::size_t Attempt::chords() const {
  constexpr std::size_t max_chords = 20;
  const std::size_t count = result.measures->deviation.opposing_faces.size();
  return count > max_chords ? 0 : count;
}

bool Attempt::is_good() const {
  constexpr double good_angle = 25, kept_share = .8;
  return keeps_promises() && angle >= std::min(good_angle, kept_share * unmended_angle);
}

bool Attempt::is_better_than(const Attempt& other) const {
  return std::tuple(flaws(), lost_angle, -angle) < std::tuple(other.flaws(), other.lost_angle, -other.angle);
}

AttemptMaker::AttemptMaker(const TriMesh& mesh, const MemoryOrder& memory_order,
                           const RemeshOptions& remesh_options, const PreservationOptions& preservation,
                           const KnownInput& known, const Observer& observer, Stopwatch* stopwatch,
                           bool smooths_steps)
    : options(remesh_options),
      lengths{memory_order.order.gather(vertex_values(mesh, target_length_property)), {}},
      mesh_(mesh),
      memory_order_(memory_order),
      observer_(observer),
      stopwatch_(stopwatch),
      input_(memory_order.order.gather(vertex_points(mesh)), *memory_order.adjacency,
             memory_order.order.old_ids(), known.tree_order, joined_vertices(mesh, memory_order.order)),
      preservation_(preservation),
      input_quality_(known.quality ? *known.quality : measure(input_, mesh, memory_order.order, stopwatch)),
      polygons_(known.polygons) {
  if (polygons_ != nullptr) {
    if (options.connectivity != ConnectivityMode::fixed)
      throw Error("known polygons; expected connectivity fixed, where faces stay");
    polygon_deviation_ = deviation_of(mesh, *polygons_);
  }
  if (adapts()) {
    std::vector<int> shells = label_shells(input_.adjacency, input_.joined);
    const int count = shells.empty() ? 0 : std::ranges::max(shells) + 1;
    if (count > 1) {
      input_.set_shells(std::move(shells), count);
      shell_of_face_.resize(input_.adjacency.faces.size());
      for (std::size_t f = 0; f < shell_of_face_.size(); ++f)
        shell_of_face_[memory_order_.order.old_face[f]] = input_.shell_of_face(static_cast<int>(f));
    }
  }
  if (preservation_.max_distance) options.filter.max_distance = *preservation_.max_distance;
  const bool may_smooth =
      smooths_steps && options.constraints.features.drops_noise && options.constraints.hard_edges.empty();
  const bool is_mask = may_smooth && is_marched_mask_at_any_length();
  is_mask_ = is_mask && (options.constraints.features.angle >= 180 ||
                         is_marched_mask(input_.points, input_.adjacency, lengths.of_vertices));
  resolves_steps_ = is_mask && !is_mask_;
  const bool is_noise = is_mask_ || (options.constraints.features.drops_noise &&
                                     is_staircase(input_.points, input_.adjacency, lengths.of_vertices));
  if (is_noise) preservation_.feature_angle = 180;
  if (is_mask_) smooth_steps();
  const TargetLengths targets = target_lengths_of(mesh, memory_order.order, input_.adjacency);
  OpenMesh::EPropHandleT<double> ratios;
  const bool has_rest_ratios = mesh.get_property_handle(ratios, rest_ratio_property);
  has_even_lengths_ =
      are_even(input_.adjacency,
               has_rest_ratios ? spread_target_lengths(input_.adjacency, lengths.of_vertices) : targets);
  if (has_even_lengths_) least_angle_ = (1 - angle_rounding) * input_quality_.min_angle.min;
  least_mean_shape_ = input_quality_.shape.mean;
  if (preservation_.has_float_points) allow_for_rounding();
  if (has_rest_ratios)
    least_angle_ = std::min(least_angle_,
                            NearRegular::share_of_rest_angle * least_rest_angle(input_.adjacency, targets));
  preservation_.faceted =
      !is_noise && is_faceted(input_.points, input_.adjacency) &&
      !has_grid_bevels(input_.points, input_.adjacency, lengths.of_vertices, options.constraints.features);
  preservation_.keeps_facets = preservation_.faceted && !adapts();
}

void AttemptMaker::judge_by_scale_of(const Attempt& a) {
  preservation_.scale = {input_.extent.diagonal, a.result.measures->quality.edge_length.mean};
}

AttemptMaker AttemptMaker::for_part(const PartOfMesh& part, const MemoryOrder& part_order,
                                    const Attempt& whole) const {
  RemeshOptions of_part = options;
  of_part.constraints = part.constraints;
  of_part.map = true;
  const auto crossings = [](const Quality& q) {
    return static_cast<long long>(q.self_intersections.value_or(0));
  };
  const long long before = crossings(input_quality_), after = crossings(whole.result.measures->quality);
  AttemptMaker maker(part.mesh, part_order, of_part, preservation_, {}, observer_, stopwatch_, false);
  maker.preservation_ = preservation_;  // faceted and rough as the whole
  maker.preservation_.more_crossings = after > before ? -before : before - after;
  maker.share_of_whole_ = static_cast<double>(part.faces.size()) / static_cast<double>(mesh_.n_faces());
  return maker;
}

/// What stands still or is put back is rounded too.
void AttemptMaker::allow_for_rounding() {
  const Quality rounded = measure_quality(rounded_to_floats(input_.points), input_.adjacency, {},
                                          {.self_intersections = false, .worst_faces = 0});
  least_angle_ = std::min(least_angle_, (1 - angle_rounding) * rounded.min_angle.min);
  least_mean_shape_ = std::min(least_mean_shape_, rounded.shape.mean);
}

Mat3X AttemptMaker::as_written(const Eigen::Ref<const Mat3X>& points) const {
  return preservation_.has_float_points ? rounded_to_floats(points) : Mat3X(points);
}

std::vector<int> AttemptMaker::with_copies(const std::vector<int>& vertices) const {
  if (input_.joined.empty()) return vertices;
  std::vector<char> is_meant(input_.joined.size(), 0);
  for (int v : vertices) is_meant[input_.joined[v]] = 1;
  std::vector<int> all;
  for (std::size_t v = 0; v < input_.joined.size(); ++v)
    if (is_meant[input_.joined[v]]) all.push_back(static_cast<int>(v));
  return all;
}

double AttemptMaker::least_angle() const {
  constexpr double small_angle = 25, kept_in_flips = .999;
  switch (options.connectivity) {
    case ConnectivityMode::fixed:
      return least_angle_;
    case ConnectivityMode::flip:
      return std::min(kept_in_flips * least_angle_, small_angle);
    case ConnectivityMode::adapt:
      break;
  }
  return 0;
}

bool AttemptMaker::has_worse_faces(const Attempt& a, double margin) const {
  if (polygons_ != nullptr) return has_worse_polygons(a);
  constexpr double more = 1.1, few = .005;  // of the slivers before; of all faces
  const Quality& quality = a.result.measures->quality;
  const bool has_more_slivers =
      static_cast<double>(quality.faces_below_20) >
      more * static_cast<double>(input_quality_.faces_below_20) + few * static_cast<double>(a.mesh.n_faces());
  return quality.shape.mean < least_mean_shape_ - (has_more_slivers ? 0 : margin);
}

std::vector<Mirror> AttemptMaker::mirrors() const {
  const Mat3X points = vertex_points(mesh_);
  return polygons_ != nullptr ? find_mirrors(points, *polygons_) : find_mirrors(points, triangles_of(mesh_));
}

bool AttemptMaker::has_worse_polygons(const Attempt& a) const {
  if (polygons_ == nullptr) return false;
  constexpr double rounding = 1e-3;  // degrees
  return deviation_of(a.mesh, *polygons_) > polygon_deviation_ + rounding;
}

std::vector<int> AttemptMaker::vertices_of_worse_polygons(const Attempt& a, double margin) const {
  return memory_order_.order.new_vertices(
      hooke::vertices_of_worse_polygons(vertex_points(a.mesh), vertex_points(mesh_), *polygons_, margin));
}

bool AttemptMaker::is_marched_mask_at_any_length() const {
  const std::vector<double> any(lengths.of_vertices.size(), std::numeric_limits<double>::infinity());
  return is_marched_mask(input_.points, input_.adjacency, any);
}

/// Lets attempts start from the input with its steps smoothed and no creases; boundaries, seams, junctions
/// and fixed vertices stay.
void AttemptMaker::smooth_steps() {
  const Adjacency& c = input_.adjacency;
  std::vector<char> is_held(c.vertex_count, 0);
  const auto hold_edge = [&](const Edge& e) {
    for (int v : e) is_held[v] = 1;
  };
  for (std::size_t e = 0; e < c.edges.size(); ++e)
    if (c.is_boundary_edge(static_cast<int>(e))) hold_edge(c.edges[e]);
  std::ranges::for_each(memory_order_.order.new_edges(options.constraints.seams), hold_edge);
  for (int v : memory_order_.order.new_vertices(options.constraints.fixed_vertices)) is_held[v] = 1;
  for (int v : find_junctions(c, input_.joined).vertices) is_held[v] = 1;
  smoothed_ = memory_order_.order.scatter(without_steps(input_.points, c, is_held));
  double& angle = options.constraints.features.angle;
  if (angle < 180) steps_ = static_cast<int>(sharp_edges(input_.points, c, angle).size());
  angle = 180;
}

Attempt AttemptMaker::run() const {
  Attempt a;
  a.mesh = mesh_;
  set_vertex_values(a.mesh, target_length_property, memory_order_.order.scatter(lengths.of_vertices));
  if (is_mask_) vertex_points(a.mesh) = smoothed_;
  RunOptions of_run(options);
  of_run.chosen.map = options.map || input_.shell_count() > 0;  // tells which shell a vertex is on
  int& tested = of_run.slivers.min_in_all;
  tested = static_cast<int>(std::ceil(share_of_whole_ * tested));
  a.run = std::make_shared<Run>(a.mesh, memory_order_, of_run, observer_, stopwatch_, lengths.shorter);
  a.result = a.run->remesh(a.mesh);
  a.result_of_run = a.run->results();
  if (!adapts() || !has_tolerance()) a.run.reset();
  a.lengths = lengths;
  a.made_faces = static_cast<double>(a.mesh.n_faces());
  vertex_points(a.mesh) = as_written(vertex_points(a.mesh));
  if (resolves_steps_) a.result.steps = MaskSteps::resolved;
  if (is_mask_) {
    if (smoothed_ != vertex_points(mesh_)) a.result.steps = MaskSteps::smoothed;
    a.result.creases.sharp = a.result.creases.dropped = steps_;
    a.result.input_points = vertex_points(mesh_);
  }
  return a;
}

bool AttemptMaker::has_tolerance() const {
  return std::isfinite(options.filter.max_distance);
}

std::optional<Attempt> AttemptMaker::go_on(const Attempt& last) const {
  if (!last.run || last.run->results() != last.result_of_run || is_mask_) return std::nullopt;
  const Mat3X points = vertex_points(last.mesh), before = as_written(last.run->points(mesh_));
  std::vector<int> placed;
  for (int v = 0; v < points.cols(); ++v)
    if (points.col(v) != before.col(v)) placed.push_back(v);
  Attempt next;
  next.mesh = mesh_;
  next.run = last.run;
  std::optional<RemeshResult> result =
      next.run->go_on(next.mesh, last.result, placed, points, lengths.of_vertices, lengths.shorter);
  if (!result) return std::nullopt;
  next.result = std::move(*result);
  if (resolves_steps_) next.result.steps = MaskSteps::resolved;
  vertex_points(next.mesh) = as_written(vertex_points(next.mesh));
  next.lengths = lengths;
  next.result_of_run = next.run->results();
  next.made_faces = next.run->share_of_last() * static_cast<double>(next.mesh.n_faces());
  return next;
}

void AttemptMaker::judge(Attempt& a) const {
  const bool is_first = !a.result.measures;
  a.result.measures.reset();
  if (!vertex_points(a.mesh).allFinite()) return;
  const Permutation& order = a.result.memory_order.order;
  const MeasuredSurface surface = timed(stopwatch_, "tree", [&] { return surface_of(a); });
  ResultMeasures m;
  m.quality = timed(stopwatch_, "after", [&] { return measure(surface, a.mesh, order, stopwatch_); });
  const std::vector<Edge> before = input_creases(a), after = order.new_edges(a.result.crease_edges);
  m.input_quality = input_quality_;
  apply_creases(m.input_quality, input_, before);
  apply_creases(m.quality, surface, after);
  m.deviation =
      timed(stopwatch_, "deviation", [&] { return measure_deviation(input_, surface, stopwatch_); });
  m.preservation = timed(stopwatch_, "preservation", [&] {
    return measure_preservation({input_, m.input_quality, before}, {surface, m.quality, after}, m.deviation,
                                preservation_);
  });
  m.judged_by = preservation_;
  a.angle = m.quality.worst_faces.front().min_angle;
  const bool has_unfolded = m.quality.folded_edges < m.input_quality.folded_edges;
  if (is_first) a.unmended_angle = a.angle;
  a.least_angle = has_unfolded ? std::min(least_angle(), a.unmended_angle) : least_angle();
  a.lost_angle = a.angle < a.least_angle;
  a.result.measures = std::make_shared<ResultMeasures>(std::move(m));
}

std::size_t AttemptMaker::flaws_within(double max_distance, const Attempt& a) const {
  const ResultMeasures& m = *a.result.measures;
  PreservationOptions within = preservation_;
  within.max_distance = max_distance;
  const std::vector<Edge> before = input_creases(a),
                          after = a.result.memory_order.order.new_edges(a.result.crease_edges);
  return measure_preservation({input_, m.input_quality, before}, {surface_of(a), m.quality, after},
                              m.deviation, within)
      .flaws();
}

std::vector<Edge> AttemptMaker::input_creases(const Attempt& a) const {
  return memory_order_.order.new_edges(a.result.input_creases);
}

MeasuredSurface AttemptMaker::surface_of(const Attempt& a) const {
  const MemoryOrder& memory_order = a.result.memory_order;
  const bool same_faces = memory_order.adjacency->faces.size() == input_.adjacency.faces.size() &&
                          options.connectivity == ConnectivityMode::fixed;
  MeasuredSurface surface(memory_order.order.gather(vertex_points(a.mesh)), *memory_order.adjacency,
                          memory_order.order.old_ids(), same_faces ? input_.tree.order() : std::vector<int>(),
                          joined_vertices(a.mesh, memory_order.order));
  if (input_.shell_count() > 0) {
    std::vector<int> shells;
    for (int v = 0; v < surface.adjacency.vertex_count; ++v) shells.push_back(shell_of_vertex(v, a));
    surface.set_shells(std::move(shells), input_.shell_count());
  }
  return surface;
}

int AttemptMaker::shell_of_vertex(int vertex, const Attempt& a) const {
  if (input_.shell_count() == 0) return -1;
  const int face = a.result.map[a.result.memory_order.order.old_vertex[vertex]].position.face;
  return face < 0 ? -1 : shell_of_face_[face];
}

ClosestPoint AttemptMaker::closest_on_input(int vertex, const Vec3& x, const Attempt& a) const {
  return input_.tree_of(shell_of_vertex(vertex, a)).closest(x);
}

void AttemptMaker::place(int vertex, const Vec3& exact, Attempt& a) const {
  const int id = a.result.memory_order.order.old_vertex[vertex];
  const Vec3 point = as_written(exact);
  vertex_points(a.mesh).col(id) = point;
  if (a.result.map.empty()) return;
  const ClosestPoint closest = closest_on_input(vertex, point, a);
  if (closest.face < 0) return;
  a.result.map[id].position = {memory_order_.order.old_face[closest.face],
                               on_face(closest, input_.points, input_.adjacency).weights};
}

}  // namespace hooke
