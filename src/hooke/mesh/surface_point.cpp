#include "hooke/mesh/surface_point.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace hooke {
namespace {

/// The hub of a fan of more is passed by: its faces beside the hint and at that one's other neighbours are
/// visited in any case, and all of them from each of thousands of vertices around it would take forever.
constexpr std::size_t max_faces_of_neighbour = 48;

/// At a hub of more only the faces about the closest are visited, and its neighbours there: the others are
/// farther around it.
constexpr std::size_t max_faces_of_hub = 64;

/// Squared distance of x to the box of the corners: a lower bound on that to the face.
double squared_distance_to_box(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& x) {
  const Vec3 lower = a.cwiseMin(b).cwiseMin(c), upper = a.cwiseMax(b).cwiseMax(c);
  return (lower - x).cwiseMax(x - upper).cwiseMax(0).squaredNorm();
}

/// Updates the closest point by the face.
void update_by_face(const Mat3X& points, const Adjacency& adjacency, const Vec3& x, int f,
                    ClosestPoint& closest) {
  const Triangle& t = adjacency.faces[f];
  const Vec3 a = points.col(t[0]), b = points.col(t[1]), c = points.col(t[2]);
  if (squared_distance_to_box(a, b, c, x) >= closest.squared_distance) return;
  const ClosestPoint of_face = closest_point(x, a, b, c);
  if (of_face.squared_distance < closest.squared_distance)
    closest = {of_face.point, of_face.squared_distance, f};
}

/// The next face around the vertex, in the order of the corners or against it; -1 at a boundary.
int next_face_around(const Adjacency& adjacency, int vertex, int face, bool forward) {
  const Triangle& t = adjacency.faces[face];
  const std::size_t corner = std::ranges::find(t, vertex) - t.begin();
  const auto& [left, right] =
      adjacency.edge_faces[adjacency.face_edges[face][forward ? (corner + 2) % 3 : corner]];
  return left == face ? right : left;
}

/// The closest point on the faces around a hub: of some of them, and of those next
/// to the closest of these as long as they get closer within a few steps. Of all if the hub itself is closest
/// on these, as from there no way leads closer.
ClosestPoint closest_at_hub(const Mat3X& points, const Adjacency& adjacency, const Vec3& x, int hub) {
  const std::span<const int> faces = adjacency.vertex_faces[hub];
  const auto stride = static_cast<std::size_t>(std::sqrt(static_cast<double>(faces.size())));
  ClosestPoint closest;
  for (std::size_t k = 0; k < faces.size(); k += stride)
    update_by_face(points, adjacency, x, faces[k], closest);
  if (!(closest.squared_distance < (points.col(hub) - x).squaredNorm())) {
    for (const int f : faces) update_by_face(points, adjacency, x, f, closest);
    return closest;
  }
  for (const bool forward : {false, true}) {
    int f = closest.face;
    for (std::size_t steps = 0; f >= 0 && steps < 2 * stride; ++steps) {
      f = next_face_around(adjacency, hub, f, forward);
      if (f < 0) break;
      const double before = closest.squared_distance;
      update_by_face(points, adjacency, x, f, closest);
      if (closest.squared_distance < before) steps = 0;
    }
  }
  return closest;
}

}  // namespace

SurfacePoint on_face(const ClosestPoint& point, const Mat3X& points, const Adjacency& adjacency) {
  const auto& [a, b, c] = adjacency.faces[point.face];
  return {point.face, barycentric(point.point, points.col(a), points.col(b), points.col(c))};
}

int nearest_corner(const SurfacePoint& place, const Adjacency& adjacency) {
  Eigen::Index corner = 0;
  place.weights.maxCoeff(&corner);
  return adjacency.faces[place.face][corner];
}

ClosestPoint closest_point_nearby(const Mat3X& points, const Adjacency& adjacency, const Vec3& x, int hint,
                                  const ClosestPoint& known) {
  ClosestPoint closest = known;
  const auto visit = [&](int vertex) {
    for (int f : adjacency.vertex_faces[vertex]) {
      const Triangle& t = adjacency.faces[f];
      if (vertex != hint && std::ranges::find(t, hint) != t.end()) continue;  // visited with the hint
      update_by_face(points, adjacency, x, f, closest);
    }
  };
  const auto visit_neighbours = [&](std::span<const int> neighbours) {
    for (int n : neighbours)
      if (n != hint && adjacency.vertex_faces[n].size() <= max_faces_of_neighbour) visit(n);
  };
  for (;;) {
    const double before = closest.squared_distance;
    if (adjacency.vertex_faces[hint].size() <= max_faces_of_hub) {
      visit(hint);
      visit_neighbours(adjacency.vertex_neighbours[hint]);
    } else if (const ClosestPoint at_hub = closest_at_hub(points, adjacency, x, hint); at_hub.face >= 0) {
      if (at_hub.squared_distance < closest.squared_distance) closest = at_hub;
      visit_neighbours(adjacency.faces[at_hub.face]);
    }
    if (!(closest.squared_distance < before)) return closest;
    const int nearest = nearest_corner(on_face(closest, points, adjacency), adjacency);
    if (nearest == hint) return closest;
    hint = nearest;
  }
}

SurfacePoint locate(const Mat3X& points, const Adjacency& adjacency, const Vec3& x, int hint) {
  const ClosestPoint closest = closest_point_nearby(points, adjacency, x, hint);
  return closest.face < 0 ? SurfacePoint{} : on_face(closest, points, adjacency);
}

}  // namespace hooke
