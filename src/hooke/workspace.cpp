#include "hooke/workspace.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "hooke/parallel.h"

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
                     const GuardOptions& guard_options, Stopwatch* stopwatch_or_none)
    : stopwatch(stopwatch_or_none),
      filter_(filter),
      guard_options_(guard_options),
      retraction_options_(retraction_options) {
  const std::vector<double> length = vertex_values(source, target_length_property);
  normalisation = normalisation_of(positions(source), length);

  const int n = static_cast<int>(source.n_vertices());
  timed(stopwatch, "order", [&] {
    const Connectivity given = make_connectivity(n, triangles_of(source));
    order = reorder(given, locality_order(given));
    connectivity = std::make_shared<const Connectivity>(make_connectivity(n, order.faces));
    sweeps = plan_sweeps(*connectivity);
  });

  start.resize(3, n);
  vertex_length.resize(length.size());
  const auto input = positions(source);
  for (int v = 0; v < n; ++v) {
    const int old = order.old_vertex[static_cast<size_t>(v)];
    start.col(v) = (input.col(old) - normalisation.centre) / normalisation.unit;
    vertex_length[static_cast<size_t>(v)] = length[static_cast<size_t>(old)] / normalisation.unit;
  }
  targets = spread_target_lengths(*connectivity, vertex_length);
  lengths_ = LengthField(start, connectivity, vertex_length);
  length_anchors_ = identity(n);
  ConstraintOptions reordered = constraint_options;
  reordered.fixed_vertices = order.new_vertices(constraint_options.fixed_vertices);
  constraints =
      timed(stopwatch, "constraints", [&] { return find_constraints(start, *connectivity, reordered); });
  mesh = build_mesh(start, *connectivity);

  const Stage stage(stopwatch, "fit");
  const SurfaceField field(start, connectivity, filter_);
  input_anchors_ = identity(n);
  to_input_ = std::make_unique<Retraction>(field.surface(), constraints, retraction_options_);
  retraction = std::make_unique<Retraction>(field.surface(), constraints, retraction_options_);
  placement = retraction->place(start, input_anchors_, constraints.segment);
}

void Workspace::refit() {
  const Stage stage(stopwatch, "fit");
  refitted_ = true;
  const SurfaceField field(placement.points, connectivity, filter_);
  finished_ += retraction->counts();
  retraction = std::make_unique<Retraction>(field.surface(), constraints, retraction_options_);
  placement = retraction->place(placement.points, identity(connectivity->vertex_count), placement.segments);
}

int Workspace::land() {
  const Stage stage(stopwatch, "land");
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
        ++more;
      }
    if (more == 0) break;
  }
  placement = std::move(landed);
  positions(mesh) = placement.points;
  return static_cast<int>(std::count(stays.begin(), stays.end(), 1));
}

void Workspace::replace_faces(std::vector<Triangle> faces) {
  connectivity =
      std::make_shared<const Connectivity>(make_connectivity(connectivity->vertex_count, std::move(faces)));
  sweeps = plan_sweeps(*connectivity);
  targets = spread_target_lengths(*connectivity, vertex_length);
  hooke::replace_faces(mesh, *connectivity);
  positions(mesh) = placement.points;
  input_anchors_ = placement.anchors;  // vertices may be far from where they were
  faces_replaced_ = true;
}

void Workspace::resample_lengths() {
  if (lengths_.uniform()) return;
  parallel_for(vertex_length.size(), 512, [&](size_t begin, size_t end) {
    for (size_t v = begin; v < end; ++v)
      vertex_length[v] = lengths_.at(placement.points.col(static_cast<Eigen::Index>(v)), length_anchors_[v]);
  });
  targets = spread_target_lengths(*connectivity, vertex_length);
  lengths_resampled_ = true;
}

void Workspace::copy_back(TriMesh& target) const {
  if (faces_replaced_) {
    std::vector<Triangle> faces(connectivity->faces.size());
    for (size_t f = 0; f < faces.size(); ++f)
      for (size_t k = 0; k < 3; ++k)
        faces[static_cast<size_t>(order.old_face[f])][k] =
            order.old_vertex[static_cast<size_t>(connectivity->faces[f][k])];
    hooke::replace_faces(target, make_connectivity(connectivity->vertex_count, std::move(faces)));
  }
  auto out = positions(target);
  for (Eigen::Index v = 0; v < start.cols(); ++v)
    if (placement.points.col(v) != start.col(v))
      out.col(order.old_vertex[static_cast<size_t>(v)]) =
          normalisation.centre + normalisation.unit * placement.points.col(v);
  if (!lengths_resampled_) return;
  std::vector<double> lengths(vertex_length.size());
  for (size_t v = 0; v < lengths.size(); ++v)
    lengths[static_cast<size_t>(order.old_vertex[v])] = normalisation.unit * vertex_length[v];
  set_vertex_values(target, target_length_property, lengths);
}

ProjectionCounts Workspace::projection_counts() const {
  ProjectionCounts counts = finished_;
  counts += retraction->counts();
  counts += to_input_->counts();
  return counts;
}

}  // namespace hooke
