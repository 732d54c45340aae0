#include "hooke/remesh/kept_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "hooke/springs/sizing.h"
#include "support/remeshed.h"

namespace hooke::kept_faces_test {

constexpr double asked = .5;

/// What stays of a flat grid of 10 x 10 squares.
struct KeptOfGrid : ::testing::Test {
  static RemeshOptions options() {
    RemeshOptions options;
    options.connectivity = ConnectivityMode::adapt;
    options.constraints.frozen_vertices = {0};
    return options;
  }

  /// The vertex in memory order that is the nearest to this point.
  int at(double x, double y) const {
    Eigen::Index v = 0;
    (maker.input().points.colwise() - Vec3(x, y, 0)).colwise().squaredNorm().minCoeff(&v);
    return static_cast<int>(v);
  }
  std::set<int> frozen() const {
    const std::vector<int>& ids = maker.options.constraints.frozen_vertices;
    return {ids.begin(), ids.end()};
  }

  TriMesh mesh = test::with_length(test::grid(10, test::flat), asked);
  MemoryOrder memory_order = find_memory_order(mesh);
  AttemptMaker maker{mesh, memory_order, options(), {}, {}, nullptr, nullptr, true};
};

TEST_F(KeptOfGrid, GrowsByTwiceTheRingsWhereItWasKeptAlready) {
  KeptFaces kept(maker);
  EXPECT_EQ(kept.share_of_area(), 0);
  ASSERT_TRUE(kept.add_around({at(.5, .5)}, 1));
  EXPECT_NEAR(kept.share_of_area(), .03, 1e-12);  // the six triangles at a vertex, of .005 each
  ASSERT_TRUE(kept.add_around({at(.5, .5)}, 1));
  EXPECT_NEAR(kept.share_of_area(), .12, 1e-12);  // two rings
  ASSERT_TRUE(kept.add_around({at(.1, .9)}, 1));
  EXPECT_NEAR(kept.share_of_area(), .15, 1e-12);  // one ring at another place
  EXPECT_FALSE(kept.add_around({}, 1));
}

TEST_F(KeptOfGrid, StaysUntilItIsDestroyed) {
  {
    KeptFaces kept(maker);
    ASSERT_TRUE(kept.add_around({at(.5, .5)}, 1));
    kept.hold();
    EXPECT_EQ(frozen().size(), 1 + 7);
    EXPECT_TRUE(frozen().contains(0));
    const Attempt run = maker.run();
    const Mat3X before = vertex_points(mesh), after = vertex_points(run.mesh);
    for (int v : frozen())
      EXPECT_TRUE((after.colwise() - Vec3(before.col(v))).colwise().squaredNorm().minCoeff() == 0) << v;
  }
  EXPECT_EQ(frozen(), std::set{0});
}

TEST_F(KeptOfGrid, LengthsGrowAwayFromIt) {
  KeptFaces kept(maker);
  ASSERT_TRUE(kept.add_around({at(.5, .5)}, 1));
  kept.hold();
  const std::vector<double>& lengths = maker.lengths.of_vertices;
  EXPECT_LT(lengths[at(.5, .5)], .15);
  EXPECT_GT(lengths[at(0, 0)], lengths[at(.5, .5)] + .1);
  EXPECT_LE(std::ranges::max(lengths), asked);
  for (const auto& [a, b] : maker.input().adjacency.edges) {
    const double distance = (maker.input().points.col(a) - maker.input().points.col(b)).norm();
    EXPECT_LE(std::abs(lengths[a] - lengths[b]), (1 + 1e-9) * Sizing().gradation * distance);
  }
}

}  // namespace hooke::kept_faces_test
