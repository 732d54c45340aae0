#include "hooke/filter/partition_of_unity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "hooke/mesh/normals.h"
#include "solids.h"

namespace hooke {
namespace {

struct Covered {
  test::Triangles mesh;
  Connectivity connectivity = test::connect(mesh);
  Mat3X normals = vertex_normals(mesh.points, connectivity);
  Eigen::VectorXd edge_lengths = mean_edge_lengths(mesh.points, connectivity);
  std::vector<char> unfolded = std::vector<char>(static_cast<size_t>(connectivity.vertex_count), 1);

  PatchCover cover() const {
    return PatchCover(mesh.points, connectivity, normals, edge_lengths, unfolded, {});
  }
};

TEST(PatchCover, EveryVertexIsWellInsideAPatch) {
  const Covered s{test::sphere(4, .2, 3)};
  const PatchList all = s.cover().next(SIZE_MAX);
  std::vector<double> nearest(s.unfolded.size(), 1e9);  // of the patches that hold the vertex, in radii
  for (size_t p = 0; p < all.size(); ++p)
    for (int v : all.members[static_cast<int>(p)]) {
      const double d = (s.mesh.points.col(v) - s.mesh.points.col(all.centres[p])).norm() / all.radii[p];
      nearest[static_cast<size_t>(v)] = std::min(nearest[static_cast<size_t>(v)], d);
    }
  for (double d : nearest) EXPECT_LE(d, PatchCoverOptions{}.coverage);
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
  s.unfolded[static_cast<size_t>(first)] = 0;
  const PatchList all = s.cover().next(SIZE_MAX);
  EXPECT_EQ(std::ranges::count(all.centres, first), 0);
  std::ranges::fill(s.unfolded, 0);
  EXPECT_EQ(s.cover().next(1).centres[0], first);
}

}  // namespace
}  // namespace hooke
