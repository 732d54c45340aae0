#include "hooke/geometry/triangle.h"

#include <gtest/gtest.h>

#include <random>

namespace hooke::triangle_test {

TEST(ClosestPoint, OfATriangleIsNoFartherThanAnyOfItsPoints) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const auto point = [&] { return Vec3(coordinate(random), coordinate(random), coordinate(random)); };
  for (int round = 0; round < 500; ++round) {
    const Vec3 a = point(), b = point(), x = 2 * point();
    const Vec3 c = round % 5 == 0 ? Vec3(a + .3 * (b - a)) : round % 5 == 1 ? a : point();
    const TrianglePoint closest = closest_point_on_triangle(a, b, c, x);
    EXPECT_GE(closest.weights.minCoeff(), 0);
    EXPECT_NEAR(closest.weights.sum(), 1, 1e-12);
    const Vec3& w = closest.weights;
    EXPECT_LT((w[0] * a + w[1] * b + w[2] * c - closest.point).norm(), 1e-12);
    EXPECT_NEAR((closest.point - x).squaredNorm(), closest.squared_distance, 1e-12);
    for (int i = 0; i <= 20; ++i)
      for (int j = 0; i + j <= 20; ++j) {
        const Vec3 other = a + i / 20. * (b - a) + j / 20. * (c - a);
        EXPECT_LE(closest.squared_distance, (other - x).squaredNorm() + 1e-12);
      }
  }
}

TEST(ClosestPoint, OfATriangleWithAreaByRoundingOnlyIsOnItsEdges) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0, 1);
  for (int round = 0; round < 1000; ++round) {
    const Vec3 a(share(random), share(random), share(random)),
        way(share(random), share(random), share(random));
    const Vec3 c = a + share(random) * way, x = a + share(random) * way;
    const TrianglePoint closest = closest_point_on_triangle(a, a + way, c, x);
    EXPECT_NEAR(closest.weights.sum(), 1, 1e-12);
    EXPECT_LT(closest.squared_distance, 1e-24);
  }
}

TEST(ClosestPoint, OfAPointOfTheTriangleIsItself) {
  const TrianglePoint inside =
      closest_point_on_triangle(Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3(.25, .5, 0));
  EXPECT_EQ(inside.point, Vec3(.25, .5, 0));
  EXPECT_EQ(inside.weights, Vec3(.25, .25, .5));
  EXPECT_EQ(inside.squared_distance, 0);
}

}  // namespace hooke::triangle_test
