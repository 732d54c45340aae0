#include "hooke/working_mesh/workspace.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

#include "hooke/constraints/crease_detection.h"
#include "hooke/core/parallel.h"
#include "hooke/filter/retraction.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/extent.h"
#include "hooke/mesh/topology.h"
#include "hooke/mesh/wedges.h"

namespace hooke {
namespace {

Normalisation normalisation_of(const Mat3X& points, const std::vector<double>& lengths) {
  Normalisation n;
  n.centre = .5 * points.rowwise().minCoeff() + .5 * points.rowwise().maxCoeff();
  n.unit = std::accumulate(lengths.begin(), lengths.end(), 0.) / static_cast<double>(lengths.size());
  return n;
}

constexpr double landing_tolerance = 1e-9;  // in mean target lengths

std::vector<int> identity(int count) {
  std::vector<int> ids(static_cast<size_t>(count));
  std::iota(ids.begin(), ids.end(), 0);
  return ids;
}

}  // namespace

Workspace::Workspace(const TriMesh& source, Layout layout, const ConstraintOptions& constraint_options,
                     const FilterOptions& filter, const RetractionOptions& retraction_options,
                     Stopwatch* stopwatch_or_none)
    : stopwatch(stopwatch_or_none),
      order(std::move(layout.order)),
      filter_(filter),
      retraction_options_(retraction_options) {
  const std::vector<double> length = vertex_values(source, target_length_property);
  normalisation = normalisation_of(positions(source), length);

  Mat3X points = order.in_new_order(positions(source));
  for (auto x : points.colwise()) x = ((x - normalisation.centre) / normalisation.unit).eval();
  vertex_length = order.in_new_order(length);
  for (double& l : vertex_length) l /= normalisation.unit;
  start = std::make_shared<const Mat3X>(std::move(points));
  std::vector<Edge> creases;
  for (int e : find_features(*start, *layout.connectivity, vertex_length, constraint_options.features))
    creases.push_back(layout.connectivity->edges[static_cast<size_t>(e)]);
  connect(std::move(layout.connectivity), creases);
  start_length_ = vertex_length;
  ConstraintOptions reordered = constraint_options;
  reordered.fixed_vertices = order.new_vertices(constraint_options.fixed_vertices);
  if (graded()) reordered.even_crease = 0;  // even edges are not what is asked for
  constraints =
      timed(stopwatch, "constraints", [&] { return find_constraints(*start, *connectivity, reordered); });
  origins = identity(connectivity->vertex_count);
  input_connectivity_ = connectivity;

  const Stage stage(stopwatch, "fit");
  const SurfaceField field = fit(start);
  input_anchors_ = identity(connectivity->side_count());
  to_input_ = std::make_unique<Retraction>(field.surface(), constraints,
                                           RetractionOptions{.tolerance = landing_tolerance});
  retraction = std::make_unique<Retraction>(field.surface(), constraints, retraction_options_);
  placement = retraction->place(*start, input_anchors_, constraints.segment);
}

void Workspace::connect(std::shared_ptr<const Connectivity> smooth, const std::vector<Edge>& creases) {
  connectivity = std::move(smooth);
  if (!creases.empty()) {
    Connectivity parted = *connectivity;
    part_at_creases(parted, creases);
    connectivity = std::make_shared<const Connectivity>(std::move(parted));
  }
  sweeps = plan_sweeps(*connectivity);
  targets = spread_target_lengths(*connectivity, vertex_length);
}

/// A field of which each side of a crease has its own. What it may swing out is counted in target lengths, or
/// in those that are natural for these faces where targets are shorter: a coarse mesh of a round body is no
/// polyhedron.
SurfaceField Workspace::fit(std::shared_ptr<const Mat3X> shared_points) const {
  const Mat3X& points = *shared_points;
  const double natural = natural_length(total_area(points, connectivity->faces), connectivity->faces.size());
  std::vector<double> lengths(static_cast<size_t>(connectivity->side_count()));
  for (size_t side = 0; side < lengths.size(); ++side)
    lengths[side] = std::max(
        natural, vertex_length[static_cast<size_t>(connectivity->vertex_of_side(static_cast<int>(side)))]);
  if (connectivity->creases.empty())
    return SurfaceField(std::move(shared_points), connectivity, filter_, {}, lengths);
  const auto cut = std::make_shared<const Connectivity>(cut_open(*connectivity));
  return SurfaceField(std::make_shared<const Mat3X>(side_points(points, *connectivity)), cut, filter_,
                      label_components(*cut), lengths);
}

int Workspace::chart_count() const {
  const Connectivity cut = cut_open(*connectivity);
  return measure_topology(cut).components;
}

void Workspace::refit() {
  const Stage stage(stopwatch, "fit");
  refitted_ = true;
  const SurfaceField field = fit(std::make_shared<const Mat3X>(placement.points));
  finished_ += retraction->counts();
  retraction = std::make_unique<Retraction>(field.surface(), constraints, retraction_options_);
  placement = retraction->place(placement.points, identity(connectivity->side_count()), placement.segments);
}

Placement Workspace::project_to_input() {
  if (!refitted_) input_anchors_ = placement.anchors;
  Placement landed = to_input_->place(placement.points, input_anchors_, placement.segments);
  input_anchors_ = landed.anchors;
  return landed;
}

void Workspace::return_to_input() {
  if (!refitted_) return;
  refitted_ = false;
  finished_ += retraction->counts();
  retraction = std::make_unique<Retraction>(to_input_->surface(), constraints, retraction_options_);
}

void Workspace::replace_faces(std::vector<Triangle> faces) {
  connect(
      std::make_shared<const Connectivity>(make_connectivity(connectivity->vertex_count, std::move(faces))),
      constraints.creases);
  input_anchors_ = placement.anchors;  // vertices may be far from where they were
  faces_replaced_ = true;
}

void Workspace::replace_mesh(std::vector<Triangle> faces, const std::vector<Triangle>& sides,
                             const std::vector<int>& before) {
  const auto n = before.size();
  std::vector<int> kept_as(order.old_vertex.size(), -1);  // by the ids of before
  for (size_t v = 0; v < n; ++v)
    if (before[v] >= 0)
      kept_as[static_cast<size_t>(order.old_vertex[static_cast<size_t>(before[v])])] = static_cast<int>(v);
  std::vector<int> by_id;  // in the order of the result
  by_id.reserve(n);
  std::ranges::copy_if(kept_as, std::back_inserter(by_id), [](int v) { return v >= 0; });
  for (size_t v = 0; v < n; ++v)
    if (before[v] < 0) by_id.push_back(static_cast<int>(v));
  if (!input_order_) input_order_ = order;
  std::vector<int> id(n);
  for (size_t i = 0; i < n; ++i) id[static_cast<size_t>(by_id[i])] = static_cast<int>(i);
  for (Triangle& t : faces)
    for (int& v : t) v = id[static_cast<size_t>(v)];
  const std::vector<int> local = locality_order(static_cast<int>(n), faces);
  order = reorder(std::move(faces), local);

  std::vector<int> source(n), place(n);  // where each vertex comes from, and goes to
  for (size_t v = 0; v < n; ++v) {
    source[v] = by_id[static_cast<size_t>(order.old_vertex[v])];
    place[static_cast<size_t>(source[v])] = static_cast<int>(v);
  }
  const auto arrange = [&](auto& values) {
    const auto old = values;
    for (size_t v = 0; v < n; ++v) values[v] = old[static_cast<size_t>(source[v])];
  };
  placement.points = placement.points(Eigen::all, source).eval();
  arrange(placement.segments);
  arrange(placement.drift);
  arrange(vertex_length);
  arrange(constraints.freedom);
  arrange(constraints.curve);
  arrange(constraints.segment);
  for (Edge& crease : constraints.creases)
    for (int& v : crease) v = place[static_cast<size_t>(v)];
  std::vector<int> from(n, -1);
  for (size_t v = 0; v < n; ++v)
    if (const int old = before[static_cast<size_t>(source[v])]; old >= 0)
      from[v] = origins[static_cast<size_t>(old)];
  origins = std::move(from);

  connect(
      std::make_shared<const Connectivity>(make_connectivity(static_cast<int>(n), std::move(order.faces))),
      constraints.creases);
  if (!constraints.creases.empty()) {
    std::vector<Triangle> moved;
    for (int f : order.old_face) moved.push_back(sides[static_cast<size_t>(f)]);
    source = sides_before(*connectivity, moved, source);
    constraints.further_sides = connectivity->further_sides;
  }
  placement.normals = placement.normals(Eigen::all, source).eval();
  std::vector<int> anchors;
  for (int side : source) anchors.push_back(placement.anchors[static_cast<size_t>(side)]);
  placement.anchors = std::move(anchors);
  placement.other_side = other_sides(n, constraints.further_sides);
  input_anchors_ = placement.anchors;
  retraction->resize(n);
  to_input_->resize(n);
  vertices_replaced_ = true;
}

SurfacePoint Workspace::place_on_input(int v) const {
  const std::vector<int>& anchors = refitted_ ? input_anchors_ : placement.anchors;
  return locate(*start, *input_connectivity_, placement.points.col(v),
                input_connectivity_->vertex_of_side(anchors[static_cast<size_t>(v)]));
}

void Workspace::resample_lengths() {
  if (!graded()) return;
  vertex_length = input_lengths();
  targets = spread_target_lengths(*connectivity, vertex_length);
}

bool Workspace::graded() const {
  return start_length_.vary();
}

std::vector<double> Workspace::input_lengths() const {
  std::vector<double> lengths = vertex_length;
  parallel_for(lengths.size(), 256, [&](size_t begin, size_t end) {
    for (size_t v = begin; v < end; ++v) {
      const SurfacePoint place = place_on_input(static_cast<int>(v));
      if (place.face < 0) continue;
      lengths[v] = 0;
      for (size_t k = 0; k < 3; ++k)
        lengths[v] += place.weights[static_cast<Eigen::Index>(k)] *
                      start_length_[static_cast<size_t>(
                          input_connectivity_->faces[static_cast<size_t>(place.face)][k])];
    }
  });
  return lengths;
}

int Workspace::vertex_of_input(int vertex) const {
  const int origin = origins[static_cast<size_t>(vertex)];
  return origin < 0 ? -1 : input_order().old_vertex[static_cast<size_t>(origin)];
}

std::vector<MapEntry> Workspace::map() const {
  std::vector<MapEntry> entries(order.old_vertex.size());
  parallel_for(entries.size(), 256, [&](size_t begin, size_t end) {
    for (size_t v = begin; v < end; ++v) {
      MapEntry& entry = entries[static_cast<size_t>(order.old_vertex[v])];
      entry.place = place_on_input(static_cast<int>(v));
      if (entry.place.face >= 0)
        entry.place.face = input_order().old_face[static_cast<size_t>(entry.place.face)];
      entry.vertex = vertex_of_input(static_cast<int>(v));
    }
  });
  return entries;
}

Mat3X Workspace::copy_back(TriMesh& target) const {
  Mat3X input = positions(target);
  Mat3X points(3, placement.points.cols());
  std::vector<double> lengths(vertex_length.size());
  for (Eigen::Index v = 0; v < points.cols(); ++v) {
    const auto place = static_cast<size_t>(order.old_vertex[static_cast<size_t>(v)]);
    const int origin = origins[static_cast<size_t>(v)];
    const bool stayed = origin >= 0 && placement.points.col(v) == start->col(origin);
    points.col(static_cast<Eigen::Index>(place)) =
        stayed ? Vec3(input.col(input_order().old_vertex[static_cast<size_t>(origin)]))
               : Vec3(normalisation.centre + normalisation.unit * placement.points.col(v));
    lengths[place] = normalisation.unit * vertex_length[static_cast<size_t>(v)];
  }
  if (vertices_replaced_)
    target = build_mesh(points, *connectivity, order.old_ids());
  else if (faces_replaced_)
    hooke::replace_faces(target, *connectivity, order.old_ids());
  positions(target) = points;
  if (graded() || vertices_replaced_) set_vertex_values(target, target_length_property, lengths);
  return input;
}

Layout Workspace::layout() const {
  if (connectivity->creases.empty()) return {order, connectivity};
  return {order, std::make_shared<const Connectivity>(without_creases(*connectivity))};
}

ProjectionCounts Workspace::projection_counts() const {
  ProjectionCounts counts = finished_;
  counts += retraction->counts();
  counts += to_input_->counts();
  return counts;
}

}  // namespace hooke
