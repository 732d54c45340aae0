#include "hooke/geometry/aabb_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace hooke {
namespace {

TEST(SpatialOrder, GoesFromNeighbourToNeighbourInAGrid) {
  constexpr int n = 16;
  std::vector<Vec3> grid;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) grid.emplace_back(i, j, k);
  const std::vector<int> order = spatial_order(grid);
  for (size_t i = 1; i < order.size(); ++i)
    ASSERT_EQ((grid[static_cast<size_t>(order[i])] - grid[static_cast<size_t>(order[i - 1])]).norm(), 1);
}

TEST(SpatialOrder, HasEveryIdOnceAndKeepsTheirOrderWherePointsCoincide) {
  EXPECT_TRUE(spatial_order({}).empty());
  EXPECT_EQ(spatial_order({Vec3::Ones(), Vec3::Ones(), Vec3::Ones()}), (std::vector<int>{0, 1, 2}));
  std::vector<Vec3> points;
  for (int i = 0; i < 1000; ++i) points.push_back(1e-40 * Vec3(i % 7, i % 11, i % 13));
  std::vector<int> order = spatial_order(points);
  std::ranges::sort(order);
  std::vector<int> ids(points.size());
  std::iota(ids.begin(), ids.end(), 0);
  EXPECT_EQ(order, ids);
}

}  // namespace
}  // namespace hooke
