#include "hooke/measure/polygon_angles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <vector>

namespace hooke {
namespace {

std::optional<PolygonAngles> angles_of(const std::vector<Vec3>& points) {
  const int n = static_cast<int>(points.size());
  Mat3X columns(3, n);
  for (int k = 0; k < n; ++k) columns.col(k) = points[k];
  IntLists polygon{{0, n}, std::vector<int>(n)};
  std::iota(polygon.items.begin(), polygon.items.end(), 0);
  return measure_polygon_angles(columns, polygon);
}

TEST(PolygonAngles, OfARegularPolygonAreEqual) {
  for (int n = 4; n <= 9; ++n) {
    std::vector<Vec3> points;
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * std::numbers::pi * k / n;
      points.emplace_back(3 * std::cos(angle), 5, 3 * std::sin(angle));
    }
    const auto angles = angles_of(points);
    ASSERT_TRUE(angles) << n;
    EXPECT_NEAR(angles->min, 180 - 360. / n, 1e-9);
    EXPECT_NEAR(angles->max, 180 - 360. / n, 1e-9);
    EXPECT_NEAR(angles->rms_deviation, 0, 1e-9);
  }
}

TEST(PolygonAngles, OfARhombusAreThoseOfItsTriangles) {
  const double h = std::numbers::sqrt3 / 2;
  const auto angles = angles_of({{0, 0, 0}, {1, 0, 0}, {1.5, h, 0}, {.5, h, 0}});
  EXPECT_NEAR(angles->min, 60, 1e-9);
  EXPECT_NEAR(angles->max, 120, 1e-9);
  EXPECT_NEAR(angles->rms_deviation, 30, 1e-9);
}

TEST(PolygonAngles, AreAbove180WhereTheyAreConcave) {
  EXPECT_NEAR(angles_of({{0, 0, 0}, {2, 0, 0}, {.5, .5, 0}, {0, 2, 0}})->max,
              360 - 180 / std::numbers::pi * std::acos(-.6), 1e-9);
}

TEST(PolygonAngles, AreNotThoseOfTriangles) {
  EXPECT_FALSE(angles_of({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}));
}

TEST(PolygonAngles, WithoutAnAngleAreZero) {
  EXPECT_EQ(angles_of({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}})->min, 0);
}

TEST(WorsePolygons, AreThoseWhoseAnglesDeviateMore) {
  Mat3X before(3, 6), after;
  before << 0, 1, 2, 0, 1, 2,  //
      0, 0, 0, 1, 1, 1,        //
      0, 0, 0, 0, 0, 0;
  const IntLists squares{{0, 4, 8, 11}, {0, 1, 4, 3, 1, 2, 5, 4, 0, 1, 4}};
  after = before;
  EXPECT_TRUE(vertices_of_worse_polygons(after, before, squares, 0).empty());
  after.col(5).x() += .5;
  EXPECT_EQ(vertices_of_worse_polygons(after, before, squares, 1), (std::vector<int>{1, 2, 4, 5}));
  EXPECT_TRUE(vertices_of_worse_polygons(after, before, squares, 80).empty());
  EXPECT_TRUE(vertices_of_worse_polygons(before, after, squares, 0).empty());
}

}  // namespace
}  // namespace hooke
