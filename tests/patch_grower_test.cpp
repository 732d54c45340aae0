#include "hooke/filter/partition_of_unity.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "hooke/mesh/normals.h"
#include "meshes.h"

namespace hooke {
namespace {

TEST(PatchGrower, FindsTheNearestVerticesAndThoseThatTie) {
  const auto t = test::sphere(3);
  const Connectivity c = make_connectivity(static_cast<int>(t.points.cols()), t.faces);
  const std::vector<char> unfolded(static_cast<size_t>(c.vertex_count), 1);
  PatchGrower grower(t.points, c, t.points, unfolded);
  for (int centre : {0, 17, 400}) {
    grower.grow(centre, 30);
    EXPECT_EQ(grower.members()[0], centre);
    EXPECT_GE(grower.members().size(), 30u);
    for (int v = 0; v < c.vertex_count; ++v) {
      const bool held = std::ranges::count(grower.members(), v) > 0;
      const double distance = (t.points.col(v) - t.points.col(centre)).norm();
      EXPECT_EQ(held, distance <= grower.farthest() * (1 + 1e-6)) << v;
    }
    EXPECT_TRUE(grower.is_inside(centre));
    EXPECT_FALSE(grower.is_inside(grower.members().back()));
  }
}

TEST(PatchGrower, DoesNotCrossAKnifeEdge) {
  // Two sheets that share a rim: the vertices 0 and 1; each sheet has a vertex of its own.
  Mat3X points(3, 4);
  points << 0, 1, .5, .5, 0, 0, 1, 1, 0, 0, .01, -.01;
  const Connectivity c = make_connectivity(4, {{0, 1, 2}, {1, 0, 3}});
  Mat3X normals(3, 4);
  normals << 0, 0, 0, 0, -1, -1, 0, 0, 0, 0, 1, -1;
  const std::vector<char> unfolded = {0, 0, 1, 1};
  PatchGrower grower(points, c, normals, unfolded);
  grower.grow(2, 30);
  EXPECT_EQ(grower.members(), (std::vector<int>{2, 1, 0}));
  EXPECT_TRUE(grower.is_inside(0));  // as far as the cone admits its ring
}

}  // namespace
}  // namespace hooke
