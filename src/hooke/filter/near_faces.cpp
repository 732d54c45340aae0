#include "hooke/filter/near_faces.h"

#include <algorithm>
#include <limits>

#include "hooke/geometry/closest_point.h"

namespace hooke {
namespace {

/// From x to the box about the corners, which no point of the face is closer than.
double squared_distance_to_box(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& x) {
  const Vec3 lower = a.cwiseMin(b).cwiseMin(c), upper = a.cwiseMax(b).cwiseMax(c);
  return (lower - x).cwiseMax(x - upper).cwiseMax(0).squaredNorm();
}

}  // namespace

int NearFaces::nearest_vertex(const Vec3& x, int vertex) const {
  double least = (points.col(vertex) - x).squaredNorm();
  for (int from = -1; from != vertex;) {
    from = vertex;
    for (int n : connectivity.vertex_neighbours[from]) {
      const double distance2 = (points.col(n) - x).squaredNorm();
      if (!(distance2 < least)) continue;  // ends the walk for NaN too
      least = distance2;
      vertex = n;
    }
  }
  return vertex;
}

Foot NearFaces::closest_point_of_ring(const Vec3& x, int anchor) const {
  Foot foot{x, Vec3::Zero(), anchor, FootStatus::no_cover, 0};
  double least = std::numeric_limits<double>::infinity();
  const auto visit = [&](int v) {
    for (int f : connectivity.vertex_faces[v]) {
      const Triangle& face = connectivity.faces[static_cast<std::size_t>(f)];
      if (v != anchor && std::ranges::find(face, anchor) != face.end()) continue;  // seen with the anchor
      const Vec3 a = points.col(face[0]), b = points.col(face[1]), c = points.col(face[2]);
      if (squared_distance_to_box(a, b, c, x) >= least) continue;
      const TrianglePoint near = closest_point_on_triangle(a, b, c, x);
      if (near.squared_distance >= least) continue;
      least = near.squared_distance;
      foot.point = near.point;
      foot.normal.setZero();
      for (int k = 0; k < 3; ++k)
        foot.normal += near.weights[k] * normals.col(face[static_cast<std::size_t>(k)]);
      Eigen::Index corner;
      near.weights.maxCoeff(&corner);
      foot.anchor = face[static_cast<std::size_t>(corner)];
      foot.status = FootStatus::converged;
    }
  };
  visit(anchor);
  for (int n : connectivity.vertex_neighbours[anchor]) visit(n);
  foot.normal.normalize();
  return foot;
}

bool NearFaces::has_face_within(const Vec3& x, int anchor, double distance) const {
  return std::ranges::any_of(connectivity.vertex_faces[anchor], [&](int f) {
    const Triangle& face = connectivity.faces[static_cast<std::size_t>(f)];
    return closest_point_on_triangle(points.col(face[0]), points.col(face[1]), points.col(face[2]), x)
               .squared_distance <= distance * distance;
  });
}

Foot NearFaces::closest_point(const Vec3& x, int anchor) const {
  Foot foot = closest_point_of_ring(x, anchor);
  while (foot.anchor != anchor) {
    anchor = foot.anchor;
    const Foot next = closest_point_of_ring(x, anchor);
    if (!((next.point - x).squaredNorm() < (foot.point - x).squaredNorm())) break;
    foot = next;
  }
  return foot;
}

}  // namespace hooke
