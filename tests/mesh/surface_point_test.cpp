#include "hooke/mesh/surface_point.h"

#include <gtest/gtest.h>

#include "hooke/geometry/aabb_tree.h"
#include "hooke/io/vertex_lists.h"
#include "hooke/mesh/adjacency.h"
#include "support/meshes.h"

namespace hooke::surface_point_test {

TEST(SurfacePoint, WalksToTheClosestPoint) {
  const test::Triangles t = test::grid(10, test::paraboloid, .3);
  const Adjacency c = make_adjacency(static_cast<int>(t.points.cols()), t.faces);
  const AabbTree tree(t.points, t.faces);
  for (int from : {0, 60, 120})
    for (const Vec3& x : {Vec3(.31, .72, .4), Vec3(.9, .15, .3), Vec3(.5, .5, 0)}) {
      const SurfacePoint found = locate(t.points, c, x, from);
      Vec3 y = Vec3::Zero();
      for (size_t k = 0; k < 3; ++k)
        y += found.weights[static_cast<Eigen::Index>(k)] * t.points.col(t.faces[found.face][k]);
      EXPECT_NEAR(found.weights.sum(), 1, 1e-12);
      EXPECT_NEAR((x - y).squaredNorm(), tree.closest(x).squared_distance, 1e-12);
    }
}

TEST(SurfacePoint, AVertexWithoutFacesLiesOnNone) {
  const Mat3X points{{0, 1, 0, 5}, {0, 0, 1, 5}, {0, 0, 0, 5}};
  EXPECT_EQ(locate(points, make_adjacency(4, {{0, 1, 2}}), points.col(3), 3).face, -1);
}

TEST(MapText, HasALinePerVertex) {
  const std::vector<MapEntry> map = {{7, {3, Vec3(.25, .75, 0)}}, {-1, {0, Vec3(0, .1, .9)}}, {2, {}}};
  EXPECT_EQ(map_text(map), "7 3 0.25 0.75 0\n-1 0 0 0.1 0.9\n2 -1 0 0 0\n");
}

}  // namespace hooke::surface_point_test
