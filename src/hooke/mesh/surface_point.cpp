#include "hooke/mesh/surface_point.h"

#include <limits>

#include "hooke/geometry/triangle.h"

namespace hooke {
namespace {

struct Nearest {
  SurfacePoint point;
  double squared_distance = std::numeric_limits<double>::infinity();

  void update(const Mat3X& points, const Adjacency& c, const Vec3& x, int vertex) {
    for (int f : c.vertex_faces[vertex]) {
      const Triangle& t = c.faces[f];
      const TrianglePoint near =
          closest_point_on_triangle(points.col(t[0]), points.col(t[1]), points.col(t[2]), x);
      if (!(near.squared_distance < squared_distance)) continue;
      squared_distance = near.squared_distance;
      point = {f, near.weights};
    }
  }
};

}  // namespace

SurfacePoint locate(const Mat3X& points, const Adjacency& c, const Vec3& x, int hint) {
  Nearest nearest;
  for (;;) {
    const double before = nearest.squared_distance;
    nearest.update(points, c, x, hint);
    for (int v : c.vertex_neighbours[hint]) nearest.update(points, c, x, v);
    if (!(nearest.squared_distance < before)) return nearest.point;
    Eigen::Index corner;
    nearest.point.weights.maxCoeff(&corner);
    hint = c.faces[nearest.point.face][corner];
  }
}

}  // namespace hooke
