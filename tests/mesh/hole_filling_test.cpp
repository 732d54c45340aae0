#include "hooke/mesh/hole_filling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace hooke::hole_filling_test {

const HasEdge no_edge = [](int, int) { return false; };

// A polygon in the plane with alternating radii.
Mat3X star(int corners, double inner) {
  Mat3X points = Mat3X::Zero(3, corners);
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * k / corners, r = k % 2 ? inner : 1;
    points.col(k) = Vec3(r * std::cos(angle), r * std::sin(angle), 0);
  }
  return points;
}

std::vector<int> all(Eigen::Index count) {
  std::vector<int> ids(count);
  std::iota(ids.begin(), ids.end(), 0);
  return ids;
}

TEST(HoleFilling, APlanePolygonIsCoveredOnceInItsOrientation) {
  for (const double inner : {1., .5, .2})
    for (const int corners : {3, 4, 5, 12, 41}) {
      const Mat3X points = star(corners, corners % 2 ? 1 : inner);
      const auto triangles = fill_polygon(points, all(corners), no_edge);
      ASSERT_TRUE(triangles);
      EXPECT_EQ(triangles->size(), static_cast<size_t>(corners) - 2);
      double area = 0, expected = 0;
      for (const Triangle& t : *triangles) {
        const double twice =
            (points.col(t[1]) - points.col(t[0])).cross(points.col(t[2]) - points.col(t[0])).z();
        EXPECT_GT(twice, -1e-12);
        area += twice / 2;
      }
      for (int k = 0; k < corners; ++k)
        expected += points.col(k).cross(points.col((k + 1) % corners)).z() / 2;
      EXPECT_NEAR(area, expected, 1e-12);
    }
}

TEST(HoleFilling, NoDiagonalIsAnEdgeThatIsThere) {
  const Mat3X points = star(4, 1);
  const auto either = fill_polygon(points, all(4), [](int a, int b) { return a == 0 && b == 2; });
  ASSERT_TRUE(either);
  for (const Triangle& t : *either) EXPECT_NE(std::ranges::find(t, 1), t.end());
  EXPECT_FALSE(fill_polygon(points, all(4), [](int, int) { return true; }));
  EXPECT_TRUE(fill_polygon(points, {0, 1, 2}, [](int, int) { return true; })) << "a triangle has no diagonal";
}

}  // namespace hooke::hole_filling_test
