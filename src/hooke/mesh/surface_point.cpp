#include "hooke/mesh/surface_point.h"

#include <algorithm>

namespace hooke {
namespace {

/// The hub of a fan of more is passed by: its faces beside the hint and at that one's other neighbours are
/// visited in any case, and all of them from each of thousands of vertices around it would take forever.
constexpr std::size_t max_faces_of_neighbour = 48;

/// Squared distance of x to the box of the corners: a lower bound on that to the face.
double squared_distance_to_box(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& x) {
  const Vec3 lower = a.cwiseMin(b).cwiseMin(c), upper = a.cwiseMax(b).cwiseMax(c);
  return (lower - x).cwiseMax(x - upper).cwiseMax(0).squaredNorm();
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
      const Vec3 a = points.col(t[0]), b = points.col(t[1]), c = points.col(t[2]);
      if (squared_distance_to_box(a, b, c, x) >= closest.squared_distance) continue;
      const ClosestPoint of_face = closest_point(x, a, b, c);
      if (of_face.squared_distance < closest.squared_distance)
        closest = {of_face.point, of_face.squared_distance, f};
    }
  };
  for (;;) {
    const double before = closest.squared_distance;
    visit(hint);
    for (int n : adjacency.vertex_neighbours[hint])
      if (adjacency.vertex_faces[n].size() <= max_faces_of_neighbour) visit(n);
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
