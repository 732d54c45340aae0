#include "hooke/working_mesh/workspace.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

#include "hooke/constraints/crease_detection.h"
#include "hooke/constraints/junction_curves.h"
#include "hooke/core/parallel.h"
#include "hooke/filter/retraction.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/extent.h"
#include "hooke/mesh/sagitta.h"
#include "hooke/mesh/topology.h"
#include "hooke/mesh/wedges.h"
#include "hooke/springs/narrow_regions.h"
#include "hooke/springs/rest_ratios.h"
#include "hooke/springs/sizing.h"

namespace hooke {
namespace {

/// About the faces, as other vertices may be so far away that little of the precision would be left.
Normalisation normalisation_of(const Mat3X& points, const std::vector<Triangle>& faces,
                               const std::vector<double>& lengths) {
  Normalisation n;
  const Eigen::AlignedBox3d box = box_of_faces(points, faces);
  if (!box.isEmpty()) n.centre = .5 * box.min() + .5 * box.max();
  n.unit = std::accumulate(lengths.begin(), lengths.end(), 0.) / static_cast<double>(lengths.size());
  return n;
}

constexpr double final_projection_tolerance = 1e-9;  // in mean target lengths

std::vector<int> identity(int count) {
  std::vector<int> ids(count);
  std::iota(ids.begin(), ids.end(), 0);
  return ids;
}

/// For each wedge that of the surface which it is, or is a part of.
std::vector<int> wedges_of_surface(const Adjacency& c, const Adjacency& surface) {
  std::vector<int> wedges = identity(c.wedge_count());
  if (&c == &surface) return wedges;
  for (size_t f = 0; f < c.faces.size(); ++f)
    for (size_t k = 0; k < 3; ++k) wedges[c.wedges_of_faces()[f][k]] = surface.wedges_of_faces()[f][k];
  return wedges;
}

/// Appends those of the edges that are not on the boundary.
void append_inner(const std::vector<Edge>& edges, const Adjacency& c, std::vector<Edge>& inner) {
  for (const auto& [a, b] : edges)
    for (const int e : c.vertex_edges[a])
      if (c.other_end(e, a) == b && !c.is_boundary_edge(e)) inner.push_back({a, b});
}

}  // namespace

Workspace::Workspace(const TriMesh& source, MemoryOrder memory_order,
                     const ConstraintOptions& constraint_options, const FilterOptions& filter,
                     const RetractionOptions& retraction_options, Stopwatch* stopwatch_or_none,
                     const std::vector<PlacedLength>& shorter)
    : stopwatch(stopwatch_or_none),
      order(std::move(memory_order.order)),
      filter_(filter),
      retraction_options_(retraction_options) {
  const std::vector<double> length = vertex_values(source, target_length_property);
  Mat3X points = order.gather(vertex_points(source));
  normalisation = normalisation_of(points, memory_order.adjacency->faces, length);
  if (filter_.offset_unit == OffsetUnit::file) filter_.offset /= normalisation.unit;
  filter_.max_distance /= normalisation.unit;

  for (auto x : points.colwise()) x = ((x - normalisation.centre) / normalisation.unit).eval();
  vertices.vertex_length = order.gather(length);
  for (double& l : vertices.vertex_length) l /= normalisation.unit;
  start_length_ = vertices.vertex_length;
  place_lengths(shorter);
  for (Eigen::Index v = 0; v < points.cols(); ++v) {
    double& l = vertices.vertex_length[v];
    l = length_at(points.col(v), l);
  }
  start = std::make_shared<const Mat3X>(std::move(points));
  std::vector<Edge> creases;
  for (int e : detect_creases(*start, *memory_order.adjacency, vertices.vertex_length,
                              constraint_options.features, order.new_edges(constraint_options.hard_edges)))
    creases.push_back(memory_order.adjacency->edges[e]);
  const std::vector<int> joined = joined_vertices(source, order);
  const Junctions junctions = find_junctions(*memory_order.adjacency, joined);
  std::vector<Edge> seams = order.new_edges(constraint_options.seams);
  std::vector<Edge> rounded = order.new_edges(constraint_options.rounded_edges);
  seams.insert(seams.end(), rounded.begin(), rounded.end());
  append_inner(junctions.edges, *memory_order.adjacency, seams);
  if (!seams.empty()) {
    sharp_ = creases;
    creases.insert(creases.end(), seams.begin(), seams.end());
  }
  connect(std::move(memory_order.adjacency), creases);
  rest_ratios_ = edge_values(source, rest_ratio_property, order, *adjacency);
  spread_lengths();
  input_surface_ = surface();
  starts_even_ = are_even(*input_surface_, spread_target_lengths(*input_surface_, start_length_.values()));
  if (std::vector<double> of_edges = edge_values(source, edge_length_property, order, *adjacency);
      !of_edges.empty()) {
    for (double& l : of_edges) l /= normalisation.unit;
    targets = from_edge_lengths(*adjacency, std::move(of_edges));
    edge_by_edge_ = true;
  }
  faceted_ = is_faceted(*start, *input_surface_) &&
             !has_grid_bevels(*start, *adjacency, vertices.vertex_length, constraint_options.features);
  ConstraintOptions reordered = constraint_options;
  std::vector<int>& fixed = reordered.fixed_vertices;
  fixed = order.new_vertices(constraint_options.fixed_vertices);
  for (int tip : detect_tips(*start, *input_surface_, vertices.vertex_length, constraint_options.features))
    fixed.push_back(tip);
  reordered.frozen_vertices = order.new_vertices(constraint_options.frozen_vertices);
  std::vector<int> held = fixed;
  held.insert(held.end(), reordered.frozen_vertices.begin(), reordered.frozen_vertices.end());
  fixed.insert(fixed.end(), junctions.vertices.begin(), junctions.vertices.end());
  reordered.junction_edges = junctions.edges;
  for (Edge& e : rounded) std::ranges::sort(e);
  std::ranges::sort(rounded);
  reordered.rounded_edges = std::move(rounded);
  if (has_varying_lengths()) reordered.even_crease = 0;  // even edges are not wanted there
  vertices.constraints =
      timed(stopwatch, "constraints", [&] { return find_constraints(*start, *adjacency, reordered); });
  constrain_junctions(*start, *adjacency, junctions, joined, held, reordered, vertices.constraints);
  vertices.origins = identity(adjacency->vertex_count);

  const Stage stage(stopwatch, "fit");
  const SurfaceField field = fit(start, input_surface_);
  input_hints_ = wedges_of_surface(*adjacency, *input_surface_);
  to_input_ = std::make_unique<Retraction>(field.surface(), vertices.constraints,
                                           RetractionOptions{.tolerance = final_projection_tolerance});
  retraction = std::make_unique<Retraction>(field.surface(), vertices.constraints, retraction_options_);
  vertices.positions =
      retraction->project_all(*start, input_hints_, std::exchange(vertices.constraints.segment, {}));
}

void Workspace::connect(std::shared_ptr<const Adjacency> smooth, const std::vector<Edge>& creases) {
  adjacency = std::move(smooth);
  if (!creases.empty()) {
    Adjacency with_wedges = *adjacency;
    split_wedges(with_wedges, creases);
    adjacency = std::make_shared<const Adjacency>(std::move(with_wedges));
  }
  coloring = color_vertices(*adjacency);
}

/// The adjacency with wedges where the surface is sharp, that is not at seams.
std::shared_ptr<const Adjacency> Workspace::surface() const {
  if (!sharp_) return adjacency;
  Adjacency sharp = without_creases(*adjacency);
  split_wedges(sharp, *sharp_);
  return std::make_shared<const Adjacency>(std::move(sharp));
}

/// Fits a field, separate on both sides of each crease. Its deviation bound is measured in target lengths.
/// Where these are shorter than the natural length of the faces it is as wide as that allows, but no wider
/// than the sagittas of the faces ask for: a coarse mesh of a round body is not to be taken for a polyhedron.
SurfaceField Workspace::fit(std::shared_ptr<const Mat3X> points,
                            const std::shared_ptr<const Adjacency>& surface) const {
  const UniformVector natural =
      start_length_.is_varying()
          ? natural_lengths_of_parts(*points, *surface, {})
          : UniformVector(surface->vertex_count,
                          natural_length(total_area(*points, surface->faces), surface->faces.size()));
  const bool has_creases = !surface->creases.empty();
  const auto cut = has_creases ? std::make_shared<const Adjacency>(cut_open(*surface)) : surface;
  if (has_creases) points = std::make_shared<const Mat3X>(wedge_points(*points, *surface));
  std::vector<double> lengths(surface->wedge_count()), longest(lengths.size());
  bool has_short = false;
  for (size_t wedge = 0; wedge < lengths.size(); ++wedge) {
    constexpr double rounding = 1e-9;
    const int v = surface->vertex_of_wedge(static_cast<int>(wedge));
    lengths[wedge] = vertices.vertex_length[v];
    longest[wedge] = natural[v];
    has_short = has_short || lengths[wedge] < (1 - rounding) * longest[wedge];
  }
  if (faceted_ || has_short) {
    constexpr double sagittas_of_bound = 2, least = 1e-3;  // where all is flat splines are flat to rounding
    const std::vector<double> rises = vertex_sagittas(face_sagittas(edge_arcs(*points, *cut), *cut), *cut);
    for (size_t wedge = 0; wedge < lengths.size(); ++wedge) {
      const double rise = std::clamp(sagittas_of_bound * rises[wedge] / filter_.max_deviation,
                                     least * longest[wedge], longest[wedge]);
      lengths[wedge] = faceted_ ? rise : std::max(lengths[wedge], rise);
    }
  }
  constexpr double share = .7;  // of the distance: chords take some
  for (double& length : lengths)
    length = std::min(length, share * filter_.max_distance / filter_.max_deviation);
  return SurfaceField(std::move(points), cut, filter_,
                      has_creases ? label_components(*cut) : std::vector<int>(), lengths);
}

void Workspace::refit() {
  const Stage stage(stopwatch, "fit");
  refitted_ = true;
  const std::shared_ptr<const Adjacency> fitted = surface();
  const SurfaceField field = fit(std::make_shared<const Mat3X>(vertices.positions.points), fitted);
  past_counts_ += retraction->counts();
  retraction = std::make_unique<Retraction>(field.surface(), vertices.constraints, retraction_options_);
  vertices.positions = retraction->project_all(
      vertices.positions.points, wedges_of_surface(*adjacency, *fitted), vertices.positions.segments);
}

SurfacePositions Workspace::project_to_input() {
  if (!refitted_) input_hints_ = vertices.positions.hints;
  SurfacePositions projected =
      to_input_->project_all(vertices.positions.points, input_hints_, vertices.positions.segments);
  input_hints_ = projected.hints;
  return projected;
}

void Workspace::return_to_input() {
  if (!refitted_) return;
  refitted_ = false;
  past_counts_ += retraction->counts();
  retraction = std::make_unique<Retraction>(to_input_->surface(), vertices.constraints, retraction_options_);
}

void Workspace::set_corner_valences() {
  vertices.corner_valences = corner_valences(vertices.positions.points, *adjacency, vertices.constraints);
}

void Workspace::replace_faces(std::vector<Triangle> faces) {
  connect(std::make_shared<const Adjacency>(make_adjacency(adjacency->vertex_count, std::move(faces))),
          vertices.constraints.creases);
  targets = spread_target_lengths(*adjacency, vertices.vertex_length);
  input_hints_ = vertices.positions.hints;  // vertices may have moved far
  faces_replaced_ = true;
}

void Workspace::replace_mesh(std::vector<Triangle> faces, const std::vector<Triangle>& wedges) {
  const std::vector<int>& before = vertices.previous_ids;
  const auto n = before.size();
  std::vector<int> kept_as(order.old_vertex.size(), -1);  // by previous id in the result
  for (size_t v = 0; v < n; ++v)
    if (before[v] >= 0) kept_as[order.old_vertex[before[v]]] = static_cast<int>(v);
  std::vector<int> by_id;  // vertices in the order of the result
  by_id.reserve(n);
  std::ranges::copy_if(kept_as, std::back_inserter(by_id), [](int v) { return v >= 0; });
  for (size_t v = 0; v < n; ++v)
    if (before[v] < 0) by_id.push_back(static_cast<int>(v));
  if (!input_order_) input_order_ = order;
  std::vector<int> id(n);
  for (size_t i = 0; i < n; ++i) id[by_id[i]] = static_cast<int>(i);
  for (Triangle& t : faces)
    for (int& v : t) v = id[v];
  const std::vector<int> local = bfs_cluster_order(static_cast<int>(n), faces);
  order = reorder(std::move(faces), local);

  // Index of the caller for each index in memory order, and its inverse.
  std::vector<int> source(n), inverse(n);
  for (size_t v = 0; v < n; ++v) {
    source[v] = by_id[order.old_vertex[v]];
    inverse[source[v]] = static_cast<int>(v);
  }
  for (Edge& crease : vertices.constraints.creases)
    for (int& v : crease) v = inverse[v];
  if (sharp_) sharp_ = vertices.constraints.creases;  // seams are no longer told from creases
  connect(std::make_shared<const Adjacency>(make_adjacency(static_cast<int>(n), std::move(order.faces))),
          vertices.constraints.creases);
  std::vector<int> source_wedges = source;
  if (!vertices.constraints.creases.empty()) {
    std::vector<Triangle> moved;
    for (int f : order.old_face) moved.push_back(wedges[f]);
    source_wedges = wedges_before(*adjacency, moved, source);
  }
  vertices.keep(source, source_wedges, adjacency->extra_wedges);
  targets = spread_target_lengths(*adjacency, vertices.vertex_length);
  input_hints_ = vertices.positions.hints;
  retraction->resize(n);
  to_input_->resize(n);
  vertices_replaced_ = true;
}

SurfacePoint Workspace::locate_on_input(int v) const {
  const std::vector<int>& hints = refitted_ ? input_hints_ : vertices.positions.hints;
  return locate(*start, *input_surface_, vertices.positions.points.col(v),
                input_surface_->vertex_of_wedge(hints[v]));
}

void Workspace::resample_lengths() {
  if (edge_by_edge_ || !has_varying_lengths()) return;
  vertices.vertex_length = input_lengths();
  spread_lengths();
}

void Workspace::spread_lengths() {
  targets = spread_target_lengths(*adjacency, vertices.vertex_length);
  if (!rest_ratios_.empty()) targets = at_rest_ratios(*adjacency, targets, rest_ratios_);
}

bool Workspace::shorten_in_narrow_regions(double shortest, double gradation) {
  const double least = shortest / normalisation.unit;
  narrow_regions_ = PlacedLengths(
      lengths_of_narrow_regions(*start, *adjacency, start_length_.values(), least), least, gradation);
  return !narrow_regions_.empty();
}

void Workspace::set_lengths(const std::vector<double>& of_input, const std::vector<PlacedLength>& shorter) {
  std::vector<double> lengths = of_input;
  for (double& length : lengths) length /= normalisation.unit;
  start_length_ = std::move(lengths);
  starts_even_ = are_even(*input_surface_, spread_target_lengths(*input_surface_, start_length_.values()));
  place_lengths(shorter);
  resample_lengths();
}

void Workspace::place_lengths(const std::vector<PlacedLength>& shorter) {
  std::vector<PlacedLength> normalised;
  for (const PlacedLength& place : shorter)
    normalised.push_back({(place.from - normalisation.centre) / normalisation.unit,
                          (place.to - normalisation.centre) / normalisation.unit,
                          place.length / normalisation.unit});
  short_places_ = PlacedLengths(normalised, 1, Sizing().gradation);
}

double Workspace::length_at(const Vec3& x, double of_vertices) const {
  return short_places_.length_at(x, narrow_regions_.length_at(x, of_vertices));
}

void Workspace::hold_others(const std::vector<char>& may_move) {
  Constraints& c = vertices.constraints;
  c.held.resize(may_move.size());
  c.frozen.resize(may_move.size(), 0);
  for (size_t v = 0; v < may_move.size(); ++v) {
    if (may_move[v] || c.frozen[v]) continue;
    c.held[v] = std::exchange(c.freedom[v], Freedom::fixed);
    c.frozen[v] = 1;
  }
}

void Workspace::release() {
  Constraints& c = vertices.constraints;
  for (size_t v = 0; v < c.held.size(); ++v) {
    if (!c.held[v]) continue;
    c.freedom[v] = *c.held[v];
    c.frozen[v] = 0;
  }
  c.held.clear();
  if (std::ranges::find(c.frozen, char{1}) == c.frozen.end()) c.frozen.clear();
}

bool Workspace::has_varying_lengths() const {
  return edge_by_edge_ || !starts_even_ || has_placed_lengths();
}

double Workspace::input_length(int v) const {
  const SurfacePoint point = locate_on_input(v);
  if (point.face < 0) return vertices.vertex_length[v];
  double length = 0;
  for (size_t k = 0; k < 3; ++k)
    length +=
        point.weights[static_cast<Eigen::Index>(k)] * start_length_[input_surface_->faces[point.face][k]];
  return length_at(vertices.positions.points.col(v), length);
}

std::vector<double> Workspace::input_lengths() const {
  std::vector<double> lengths(vertices.vertex_length.size());
  parallel_for(lengths.size(), 256, [&](size_t begin, size_t end) {
    for (size_t v = begin; v < end; ++v) lengths[v] = input_length(static_cast<int>(v));
  });
  return lengths;
}

int Workspace::vertex_of_input(int vertex) const {
  const int origin = vertices.origins[vertex];
  return origin < 0 ? -1 : input_order().old_vertex[origin];
}

std::vector<MapEntry> Workspace::map() const {
  std::vector<MapEntry> entries(order.old_vertex.size());
  parallel_for(entries.size(), 256, [&](size_t begin, size_t end) {
    for (size_t v = begin; v < end; ++v) {
      MapEntry& entry = entries[order.old_vertex[v]];
      entry.position = locate_on_input(static_cast<int>(v));
      if (entry.position.face >= 0) entry.position.face = input_order().old_face[entry.position.face];
      entry.vertex = vertex_of_input(static_cast<int>(v));
    }
  });
  return entries;
}

Mat3X Workspace::points_of_result(const Mat3X& input) const {
  Mat3X points(3, vertices.positions.points.cols());
  for (Eigen::Index v = 0; v < points.cols(); ++v) {
    const int origin = vertices.origins[v];
    const bool stayed = origin >= 0 && vertices.positions.points.col(v) == start->col(origin);
    points.col(order.old_vertex[v]) =
        stayed ? Vec3(input.col(input_order().old_vertex[origin]))
               : Vec3(normalisation.centre + normalisation.unit * vertices.positions.points.col(v));
  }
  return points;
}

void Workspace::place(const std::vector<int>& ids, const Mat3X& points) {
  for (int v : order.new_vertices(ids)) {
    SurfacePositions& p = vertices.positions;
    const Vec3 point = (points.col(order.old_vertex[v]) - normalisation.centre) / normalisation.unit;
    p.drift[v] += (point - p.points.col(v)).norm();
    p.points.col(v) = point;
  }
}

Mat3X Workspace::copy_back(TriMesh& target) const {
  Mat3X input = vertex_points(target);
  const Mat3X points = points_of_result(input);
  std::vector<double> lengths(vertices.vertex_length.size());
  for (size_t v = 0; v < lengths.size(); ++v)
    lengths[order.old_vertex[v]] = normalisation.unit * vertices.vertex_length[v];
  if (vertices_replaced_)
    target = build_mesh(points, *adjacency, order.old_ids());
  else if (faces_replaced_)
    hooke::replace_faces(target, *adjacency, order.old_ids());
  vertex_points(target) = points;
  if (vertices_replaced_ && !vertices.constraints.junction.empty())
    set_joined_vertices(target, joined_in_result());
  if (has_varying_lengths() || vertices_replaced_) set_vertex_values(target, target_length_property, lengths);
  return input;
}

MemoryOrder Workspace::memory_order() const {
  if (adjacency->creases.empty()) return {order, adjacency};
  return {order, std::make_shared<const Adjacency>(without_creases(*adjacency))};
}

std::vector<int> Workspace::joined_in_result() const {
  std::vector<int> number(order.old_vertex.size()), joined = identity(static_cast<int>(number.size())),
                                                    first(vertices.constraints.junction_vertices.size(), -1);
  for (std::size_t v = 0; v < number.size(); ++v)
    number[order.old_vertex[v]] = vertices.constraints.junction[v];
  for (std::size_t id = 0; id < joined.size(); ++id) {
    if (number[id] < 0) continue;
    int& known = first[number[id]];
    if (known < 0) known = static_cast<int>(id);
    joined[id] = known;
  }
  return joined;
}

ProjectionCounts Workspace::projection_counts() const {
  ProjectionCounts counts = past_counts_;
  counts += retraction->counts();
  counts += to_input_->counts();
  return counts;
}

}  // namespace hooke
