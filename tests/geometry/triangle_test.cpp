#include "hooke/geometry/triangle.h"

#include <gtest/gtest.h>

#include <random>

namespace hooke::triangle_test {

TEST(ClosestPoint, KnownCases) {
  const Vec3 a(0, 0, 0), b(4, 0, 0), c(0, 4, 0);
  EXPECT_EQ(closest_point({1, 1, 3}, a, b, c).point, Vec3(1, 1, 0));
  EXPECT_EQ(closest_point({1, 1, 3}, a, b, c).squared_distance, 9);
  EXPECT_EQ(closest_point({-1, -1, 0}, a, b, c).point, a);
  EXPECT_EQ(closest_point({1, -2, 0}, a, b, c).point, Vec3(1, 0, 0));
  EXPECT_EQ(closest_point({4, 4, 1}, a, b, c).point, Vec3(2, 2, 0));
  EXPECT_EQ(closest_point({9, -1, 0}, a, b, c).point, b);
}

TEST(ClosestPoint, OfATriangleIsNoFartherThanAnyOfItsPoints) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const auto point = [&] { return Vec3(coordinate(random), coordinate(random), coordinate(random)); };
  for (int round = 0; round < 500; ++round) {
    const Vec3 a = point(), b = point(), x = 2 * point();
    const Vec3 c = round % 5 == 0 ? Vec3(a + .3 * (b - a)) : round % 5 == 1 ? a : point();
    const ClosestPoint closest = closest_point(x, a, b, c);
    const Vec3 w = barycentric(closest.point, a, b, c);
    EXPECT_GE(w.minCoeff(), 0);
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
  const auto point = [&] { return Vec3(share(random), share(random), share(random)); };
  for (double offset : {0., 1e3})
    for (int round = 0; round < 1000; ++round) {
      const double rounding = 1e-14 * std::max(1., offset);
      const Vec3 a = Vec3::Constant(offset) + point(), way = point();
      const Vec3 b = a + way, c = a + share(random) * way, x = a + share(random) * way;
      const ClosestPoint closest = closest_point(x, a, b, c);
      EXPECT_LT(std::sqrt(closest.squared_distance), rounding);
      const Vec3 w = barycentric(closest.point, a, b, c);
      EXPECT_GE(w.minCoeff(), 0);
      EXPECT_LT((w[0] * a + w[1] * b + w[2] * c - x).norm(), 4 * rounding);
    }
}

TEST(ClosestPoint, OfATriangleWithoutAreaIsOnItsEdges) {
  EXPECT_EQ(closest_point({1, 1, 0}, {0, 0, 0}, {2, 0, 0}, {4, 0, 0}).point, Vec3(1, 0, 0));
  EXPECT_EQ(closest_point({1, 1, 0}, {3, 3, 3}, {3, 3, 3}, {3, 3, 3}).point, Vec3(3, 3, 3));
}

TEST(AngleBetween, IsZeroBesideAVectorWithoutLength) {
  EXPECT_EQ(angle_between({0, 0, 0}, {-1, -1, -1}), 0);
  EXPECT_EQ(angle_between({-1, -1, -1}, {0, 0, 0}), 0);
  EXPECT_EQ(angle_between({2, 0, 0}, {0, 0, 3}), 90) << "corners are counted by such angles";
  EXPECT_EQ(angle_between({2, 0, 0}, {-1, 0, 0}), 180);
}

TEST(Barycentric, WeightsRebuildThePoint) {
  const Vec3 a(0, 0, 0), b(4, 0, 1), c(0, 4, 2), x = .2 * a + .5 * b + .3 * c;
  EXPECT_TRUE(barycentric(x, a, b, c).isApprox(Vec3(.2, .5, .3), 1e-14));
  EXPECT_EQ(barycentric(b, a, b, c), Vec3(0, 1, 0));
  EXPECT_EQ(barycentric(x, a, a, a).sum(), 1);
}

}  // namespace hooke::triangle_test
