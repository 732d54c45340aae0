#include "hooke/workspace.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "hooke/creases.h"
#include "hooke/topology.h"

namespace hooke {
namespace {

Normalisation normalisation_of(const Mat3X& points, const std::vector<double>& lengths) {
  Normalisation n;
  n.centre = .5 * points.rowwise().minCoeff() + .5 * points.rowwise().maxCoeff();
  n.unit = std::accumulate(lengths.begin(), lengths.end(), 0.) / static_cast<double>(lengths.size());
  return n;
}

constexpr double landing_slack = .05;  // two fields of one surface differ a little, and that is no fold

constexpr double landing_area_ratio = .01;

std::vector<int> identity(int count) {
  std::vector<int> ids(static_cast<size_t>(count));
  std::iota(ids.begin(), ids.end(), 0);
  return ids;
}

}  // namespace

Workspace::Workspace(const TriMesh& source, const ConstraintOptions& constraint_options,
                     const FilterOptions& filter, const RetractionOptions& retraction_options,
                     const GuardOptions& guard_options)
    : filter_(filter), guard_options_(guard_options), retraction_options_(retraction_options) {
  const std::vector<double> length = vertex_values(source, target_length_property);
  normalisation = normalisation_of(positions(source), length);

  const int n = static_cast<int>(source.n_vertices());
  const Connectivity given = make_connectivity(n, triangles_of(source));
  order = reorder(given, locality_order(given));

  start.resize(3, n);
  vertex_length.resize(length.size());
  const auto input = positions(source);
  for (int v = 0; v < n; ++v) {
    const int old = order.old_vertex[static_cast<size_t>(v)];
    start.col(v) = (input.col(old) - normalisation.centre) / normalisation.unit;
    vertex_length[static_cast<size_t>(v)] = length[static_cast<size_t>(old)] / normalisation.unit;
  }
  Connectivity smooth = make_connectivity(n, order.faces);
  std::vector<Edge> creases;
  for (int e : find_features(start, smooth, vertex_length, constraint_options.features))
    creases.push_back(smooth.edges[static_cast<size_t>(e)]);
  connect(std::move(smooth), creases);
  ConstraintOptions reordered = constraint_options;
  reordered.fixed_vertices = order.new_vertices(constraint_options.fixed_vertices);
  constraints = find_constraints(start, *connectivity, reordered);
  mesh = build_mesh(start, order.faces);

  const SurfaceField field = fit(start);
  input_anchors_ = identity(connectivity->side_count());
  to_input_ = std::make_unique<Retraction>(field.surface(), constraints, retraction_options_);
  retraction = std::make_unique<Retraction>(field.surface(), constraints, retraction_options_);
  placement = retraction->place(start, input_anchors_, constraints.segment);
}

void Workspace::connect(Connectivity c, const std::vector<Edge>& creases) {
  part_at_creases(c, creases);
  sweeps = plan_sweeps(c);
  targets = spread_target_lengths(c, vertex_length);
  connectivity = std::make_shared<const Connectivity>(std::move(c));
}

/// A field of which each side of a crease has its own.
SurfaceField Workspace::fit(const Mat3X& points) const {
  if (connectivity->creases.empty()) return SurfaceField(points, connectivity, filter_);
  const auto cut = std::make_shared<const Connectivity>(cut_open(*connectivity));
  return SurfaceField(side_points(points, *connectivity), cut, filter_, label_components(*cut));
}

int Workspace::chart_count() const {
  const Connectivity cut = cut_open(*connectivity);
  return measure_topology(cut).components;
}

void Workspace::refit() {
  refitted_ = true;
  const SurfaceField field = fit(placement.points);
  finished_ += retraction->counts();
  retraction = std::make_unique<Retraction>(field.surface(), constraints, retraction_options_);
  placement = retraction->place(placement.points, identity(connectivity->side_count()), placement.segments);
}

int Workspace::land() {
  if (!refitted_) input_anchors_ = placement.anchors;
  Placement landed = to_input_->place(placement.points, input_anchors_, placement.segments);
  input_anchors_ = landed.anchors;

  GuardOptions options = guard_options_;
  options.slack = landing_slack;
  options.area_ratio = landing_area_ratio;
  options.sagitta = std::numeric_limits<double>::infinity();
  Guards guards(*connectivity, targets, options);
  guards.accept(placement);
  std::vector<char> stays(landed.anchors.size(), 0);
  for (;;) {
    int more = 0;
    for (int v : guards.offenders(landed))
      if (!std::exchange(stays[static_cast<size_t>(v)], 1)) {
        landed.points.col(v) = placement.points.col(v);
        landed.normals.col(v) = placement.normals.col(v);
        if (const int other = landed.other_side_of(v); other >= 0)
          landed.normals.col(other) = placement.normals.col(other);
        ++more;
      }
    if (more == 0) break;
  }
  placement = std::move(landed);
  positions(mesh) = placement.points;
  return static_cast<int>(std::count(stays.begin(), stays.end(), 1));
}

void Workspace::replace_faces(std::vector<Triangle> faces) {
  connect(make_connectivity(connectivity->vertex_count, std::move(faces)), constraints.creases);
  hooke::replace_faces(mesh, connectivity->faces);
  positions(mesh) = placement.points;
  input_anchors_ = placement.anchors;  // vertices may be far from where they were
  faces_replaced_ = true;
}

void Workspace::copy_back(TriMesh& target) const {
  if (faces_replaced_) {
    std::vector<Triangle> faces(connectivity->faces.size());
    for (size_t f = 0; f < faces.size(); ++f)
      for (size_t k = 0; k < 3; ++k)
        faces[static_cast<size_t>(order.old_face[f])][k] =
            order.old_vertex[static_cast<size_t>(connectivity->faces[f][k])];
    hooke::replace_faces(target, faces);
  }
  auto out = positions(target);
  for (Eigen::Index v = 0; v < start.cols(); ++v)
    if (placement.points.col(v) != start.col(v))
      out.col(order.old_vertex[static_cast<size_t>(v)]) =
          normalisation.centre + normalisation.unit * placement.points.col(v);
}

ProjectionCounts Workspace::projection_counts() const {
  ProjectionCounts counts = finished_;
  counts += retraction->counts();
  counts += to_input_->counts();
  return counts;
}

}  // namespace hooke
