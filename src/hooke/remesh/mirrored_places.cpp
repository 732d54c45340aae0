#include "hooke/remesh/mirrored_places.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hooke/core/lists.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/mesh.h"
#include "hooke/remesh/attempts.h"

namespace hooke {
namespace {

/// Does the mirror map the lengths asked for, and what stays, onto each other?
bool is_asked_alike(const AttemptMaker& maker, const Mirror& mirror, const std::vector<double>& asked,
                    const ConstraintOptions& constraints) {
  constexpr double rounding = 1e-6;
  std::vector<double> length(asked.size());  // by id
  for (int v = 0; v < std::ssize(asked); ++v) length[maker.id_of(v)] = asked[v];
  for (size_t v = 0; v < length.size(); ++v)
    if (std::abs(length[v] - length[mirror.image[v]]) > rounding * length[v]) return false;
  const auto maps_vertices = [&](std::vector<int> ids) {
    std::vector<int> images;
    for (int id : ids) images.push_back(mirror.image[id]);
    sort_unique(ids), sort_unique(images);
    return ids == images;
  };
  const auto maps_edges = [&](std::vector<Edge> edges) {
    std::vector<Edge> images;
    for (Edge& e : edges) {
      images.push_back({mirror.image[e[0]], mirror.image[e[1]]});
      std::ranges::sort(e), std::ranges::sort(images.back());
    }
    std::ranges::sort(edges), std::ranges::sort(images);
    return edges == images;
  };
  return maps_vertices(constraints.fixed_vertices) && maps_vertices(constraints.frozen_vertices) &&
         maps_edges(constraints.seams) && maps_edges(constraints.hard_edges);
}

bool is_mirrored(const Mirror& mirror, const Attempt& run, double tolerance) {
  const auto points = vertex_points(run.mesh);
  for (int v = 0; v < points.cols(); ++v)
    if ((mirror(points.col(v)) - points.col(mirror.image[v])).norm() > tolerance) return false;
  return true;
}

/// Where it has the greater least angle: 1 beyond the plane, else -1.
double better_side(const Mirror& mirror, const Attempt& run) {
  const Mat3X points = vertex_points(run.mesh);
  double least_beyond = 180, least_before = 180;
  for (const Triangle& t : triangles_of(run.mesh)) {
    double across = 0;
    for (int v : t) across += points(mirror.axis, v) - mirror.plane;
    double& least = across > 0 ? least_beyond : least_before;
    least = std::min(least, min_angle(points, {t}));
  }
  return least_beyond >= least_before ? 1 : -1;
}

/// Vertices that are in their mirrored places but for the tolerance, as those that stay, keep every bit.
void mirror_places(const AttemptMaker& maker, const Mirror& mirror, double side, double tolerance,
                   Attempt& run) {
  const Mat3X before = vertex_points(run.mesh), input = vertex_points(maker.mesh());
  std::vector<unsigned char>& limits = run.result.vertex_limits;
  for (int v = 0; v < input.cols(); ++v) {
    const int id = maker.id_of(v), image = mirror.image[id];
    Vec3 x = before.col(id);
    if (image == id) {
      x[mirror.axis] = mirror.plane;
    } else if (side * (input(mirror.axis, id) - mirror.plane) < 0) {
      x = mirror(before.col(image));
      limits[id] = limits[image];
    }
    if ((x - before.col(id)).norm() > tolerance) maker.place(v, x, run);
  }
}

/// Does it keep its promises, unless the other does not either, and are its angles hardly smaller?
bool is_hardly_worse(const AttemptMaker& maker, const Attempt& run, const Attempt& other) {
  constexpr double kept_least = .95, margin = .005;
  if (!run.result.measures || run.flaws() > other.flaws() || run.lost_angle > other.lost_angle ||
      (maker.has_worse_polygons(run) && !maker.has_worse_polygons(other)))
    return false;
  return run.angle >= kept_least * other.angle &&
         run.result.measures->quality.shape.mean >= other.result.measures->quality.shape.mean - margin;
}

}  // namespace

void keep_mirrors(const AttemptMaker& maker, const std::vector<double>& asked,
                  const ConstraintOptions& constraints, Attempt& best) {
  OpenMesh::EPropHandleT<double> of_edges;
  if (maker.options.connectivity != ConnectivityMode::fixed || !best.result.measures ||
      best.is_interrupted() || !maker.input().joined.empty() ||
      maker.mesh().get_property_handle(of_edges, edge_length_property))
    return;
  const double tolerance = mirror_tolerance * maker.input().extent.diagonal;
  for (const Mirror& mirror : maker.mirrors()) {
    if (is_mirrored(mirror, best, tolerance) || !is_asked_alike(maker, mirror, asked, constraints)) continue;
    Attempt mirrored = best;
    mirror_places(maker, mirror, better_side(mirror, best), tolerance, mirrored);
    maker.judge(mirrored);
    if (is_hardly_worse(maker, mirrored, best)) best = std::move(mirrored);
  }
}

}  // namespace hooke
