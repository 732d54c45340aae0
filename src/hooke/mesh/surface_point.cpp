#include "hooke/mesh/surface_point.h"

#include <algorithm>
#include <limits>

namespace hooke {
namespace {

/// Squared distance of x to the box of the corners: a lower bound on that to the face.
double squared_distance_to_box(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& x) {
  const Vec3 lower = a.cwiseMin(b).cwiseMin(c), upper = a.cwiseMax(b).cwiseMax(c);
  return (lower - x).cwiseMax(x - upper).cwiseMax(0).squaredNorm();
}

}  // namespace

PointOnFace closest_point_nearby(const Mat3X& points, const Adjacency& adjacency, const Vec3& x, int hint) {
  PointOnFace closest;
  closest.at.squared_distance = std::numeric_limits<double>::infinity();
  const auto visit = [&](int vertex) {
    for (int f : adjacency.vertex_faces[vertex]) {
      const Triangle& t = adjacency.faces[f];
      if (vertex != hint && std::ranges::find(t, hint) != t.end()) continue;  // visited with the hint
      const Vec3 a = points.col(t[0]), b = points.col(t[1]), c = points.col(t[2]);
      if (squared_distance_to_box(a, b, c, x) >= closest.at.squared_distance) continue;
      const TrianglePoint at = closest_point_on_triangle(a, b, c, x);
      if (at.squared_distance < closest.at.squared_distance) closest = {f, at};
    }
  };
  for (;;) {
    const double before = closest.at.squared_distance;
    visit(hint);
    for (int n : adjacency.vertex_neighbours[hint]) visit(n);
    if (!(closest.at.squared_distance < before)) return closest;
    const int nearest = nearest_corner(closest, adjacency);
    if (nearest == hint) return closest;
    hint = nearest;
  }
}

int nearest_corner(const PointOnFace& point, const Adjacency& adjacency) {
  Eigen::Index corner = 0;
  point.at.weights.maxCoeff(&corner);
  return adjacency.faces[point.face][corner];
}

SurfacePoint locate(const Mat3X& points, const Adjacency& adjacency, const Vec3& x, int hint) {
  const PointOnFace closest = closest_point_nearby(points, adjacency, x, hint);
  return {closest.face, closest.at.weights};
}

}  // namespace hooke
