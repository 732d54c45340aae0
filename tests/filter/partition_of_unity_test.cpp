#include "hooke/filter/partition_of_unity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>

#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/normals.h"
#include "support/crease_solids.h"
#include "support/meshes.h"
#include "support/solids.h"

namespace hooke::partition_of_unity_test {

struct Covered {
  test::Triangles mesh;
  Adjacency adjacency = test::connect(mesh);
  Mat3X normals = vertex_normals(mesh.points, adjacency);
  Eigen::VectorXd edge_lengths = mean_edge_lengths(mesh.points, adjacency);
  std::vector<char> unfolded = std::vector<char>(adjacency.vertex_count, 1);

  PatchCover cover() const { return PatchCover(mesh.points, adjacency, normals, edge_lengths, unfolded); }
};

TEST(PatchCover, EveryVertexIsWellInsideAPatch) {
  const Covered s{test::sphere(4, .2, 3)};
  const PatchList all = s.cover().next(SIZE_MAX);
  std::vector<double> nearest(s.unfolded.size(), 1e9);  // of the patches that hold the vertex, in radii
  for (size_t p = 0; p < all.size(); ++p)
    for (int v : all.members[static_cast<int>(p)]) {
      const double d = (s.mesh.points.col(v) - s.mesh.points.col(all.centres[p])).norm() / all.radii[p];
      nearest[v] = std::min(nearest[v], d);
    }
  for (double d : nearest) EXPECT_LE(d, patch_coverage);
}

TEST(PatchCover, IsTheSameInPieces) {
  const Covered s{test::sphere(3, .2, 3)};
  const PatchList all = s.cover().next(SIZE_MAX);
  PatchCover cover = s.cover();
  size_t found = 0;
  for (PatchList some = cover.next(7); some.size() > 0; some = cover.next(7))
    for (size_t p = 0; p < some.size(); ++p, ++found) {
      ASSERT_LT(found, all.size());
      EXPECT_EQ(some.centres[p], all.centres[found]);
      EXPECT_EQ(some.radii[p], all.radii[found]);
      EXPECT_TRUE(
          std::ranges::equal(some.members[static_cast<int>(p)], all.members[static_cast<int>(found)]));
    }
  EXPECT_EQ(found, all.size());
}

TEST(PatchCover, FoldedVerticesAreCentresOnlyWhereNothingElseCoversThem) {
  Covered s{test::sphere(3, .2, 3)};
  const int first = s.cover().next(1).centres[0];
  s.unfolded[first] = 0;
  const PatchList all = s.cover().next(SIZE_MAX);
  EXPECT_EQ(std::ranges::count(all.centres, first), 0);
  std::ranges::fill(s.unfolded, 0);
  EXPECT_EQ(s.cover().next(1).centres[0], first);
}

TEST(PatchGrower, FindsTheNearestVerticesAndThoseThatTie) {
  const auto t = test::sphere(3);
  const Adjacency c = make_adjacency(static_cast<int>(t.points.cols()), t.faces);
  const std::vector<char> unfolded(c.vertex_count, 1);
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
  // Two sheets that share the edge between vertices 0 and 1; each sheet has a vertex of its own.
  Mat3X points(3, 4);
  points << 0, 1, .5, .5, 0, 0, 1, 1, 0, 0, .01, -.01;
  const Adjacency c = make_adjacency(4, {{0, 1, 2}, {1, 0, 3}});
  Mat3X normals(3, 4);
  normals << 0, 0, 0, 0, -1, -1, 0, 0, 0, 0, 1, -1;
  const std::vector<char> unfolded = {0, 0, 1, 1};
  PatchGrower grower(points, c, normals, unfolded);
  grower.grow(2, 30);
  EXPECT_EQ(grower.members(), (std::vector<int>{2, 1, 0}));
  EXPECT_TRUE(grower.is_inside(0));  // as far as the cone admits its ring
}

TEST(PartitionOfUnity, TheHubOfAWideFanCostsNoMoreThanThatOfANarrowOne) {
  const auto seconds_at_hub = [](int sides) {
    const Covered s{test::pyramid(sides, 1, .5)};
    const PartitionOfUnity psi(s.mesh.points, s.adjacency, s.normals, s.edge_lengths);
    const Vec3 hub = s.mesh.points.col(sides);
    EXPECT_NEAR(psi(hub, sides).value, 0, 1e-6);
    double least = 1e9;
    for (int attempt = 0; attempt < 9; ++attempt) {
      const auto start = std::chrono::steady_clock::now();
      for (int i = 0; i < 100; ++i) EXPECT_LT(psi(hub + Vec3(0, .001 * i, 0), sides).value, 1);
      least =
          std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    return least;
  };
  EXPECT_LT(seconds_at_hub(6000), 4 * seconds_at_hub(300));  // twenty times as many neighbours
}

}  // namespace hooke::partition_of_unity_test
