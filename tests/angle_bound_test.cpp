#include "hooke/measure/angle_bound.h"

#include <gtest/gtest.h>

#include "hooke/geometry/triangle.h"
#include "solids.h"

namespace hooke {
namespace {

AngleBound bound(const test::Triangles& t, int face, int rings = 2) {
  return bound_least_angle(t.points, test::connect(t), face, rings);
}

TEST(AngleBound, AnEquilateralTriangleCanHaveSixtyDegrees) {
  EXPECT_NEAR(bound(test::equilateral(), 0).degrees, 60, 2e-3);
}

TEST(AngleBound, AVertexOfValenceThreeLeavesThirtyDegrees) {
  test::Triangles t = test::equilateral();
  t.points.conservativeResize(3, 4);
  t.points.col(3) = Vec3(.5, .2, 0);
  t.faces = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  const AngleBound b = bound(t, 0);
  EXPECT_NEAR(b.degrees, 30, 2e-3);
  EXPECT_FALSE(b.vertices.empty());
}

TEST(AngleBound, ACornerCutIntoThreeLeavesAThirdOfItsAngle) {
  // A fan of three faces about a right angle.
  const auto t = test::triangles({{0, 0, 0}, {1, 0, 0}, {.9, .4, 0}, {.4, .9, 0}, {0, 1, 0}},
                                 {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
  const AngleBound b = bound(t, 1);
  EXPECT_NEAR(b.degrees, 30, 2e-3);
  EXPECT_EQ(b.vertices, std::vector<int>{0});
}

TEST(AngleBound, WhatIsThereIsPossible) {
  for (unsigned seed = 1; seed < 6; ++seed) {
    const test::Triangles t = test::sphere(1, .3, seed);
    const double least = least_angle(t.points, t.faces);
    for (int f = 0; f < static_cast<int>(t.faces.size()); f += 7)
      EXPECT_GE(bound(t, f, 20).degrees, least - 2e-3);
  }
}

TEST(AngleBound, AWiderPatchBoundsMore) {
  const test::Triangles t = test::sphere(2, .3, 5);
  for (int f = 0; f < static_cast<int>(t.faces.size()); f += 11)
    EXPECT_LE(bound(t, f, 3).degrees, bound(t, f, 1).degrees + 2e-3);
}

TEST(AngleBound, TheRegularIcosahedronReachesIts) {
  const AngleBound b = bound(test::sphere(0), 0);
  EXPECT_NEAR(b.degrees, 60, 2e-3);
}

TEST(AngleBound, WhatCannotBeMeasuredIsNotBounded) {
  test::Triangles t = test::sphere(1);
  t.points *= 1e200;
  EXPECT_EQ(bound(t, 0).degrees, 60);
  EXPECT_TRUE(bound(t, 0).vertices.empty());
}

}  // namespace
}  // namespace hooke
