#include "hooke/measure/angle_bound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "hooke/geometry/triangle.h"
#include "hooke/measure/quality.h"
#include "hooke/mesh/adjacency.h"
#include "support/crease_solids.h"
#include "support/solids.h"

namespace hooke::angle_bound_test {

AngleBound bound(const test::Triangles& t, int face, int rings = 2) {
  return bound_min_angle(t.points, test::connect(t), face, rings);
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

TEST(AngleBound, AHubOfThousandsOfFacesLeavesEachItsShare) {
  const int sides = 20000;
  const test::Triangles cone = test::pyramid(sides, 1, 0);
  for (int f : {0, 1, 2 * sides - 1}) {
    const AngleBound b = bound(cone, f);
    EXPECT_NEAR(b.degrees, 360. / sides, 2e-3);
    ASSERT_EQ(b.vertices.size(), 1u);
    EXPECT_GE(b.vertices[0], sides);
  }
}

TEST(AngleBound, WhatIsThereIsPossible) {
  for (unsigned seed = 1; seed < 6; ++seed) {
    const test::Triangles t = test::sphere(1, .3, seed);
    const double least = min_angle(t.points, t.faces);
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

/// Each square of the cube is bounded by creases and has one diagonal.
std::vector<Edge> edges_of_cube(const test::Triangles& cube) {
  std::vector<Edge> edges;
  for (const Edge& e : test::connect(cube).edges)
    if ((cube.points.col(e[0]) - cube.points.col(e[1])).norm() < 1.1) edges.push_back(e);
  return edges;
}

std::vector<AngleBound> bounds_between(const std::vector<Edge>& creases, const MeasuredSurface& surface) {
  std::vector<int> faces(surface.adjacency.faces.size());
  std::iota(faces.begin(), faces.end(), 0);
  return bound_min_angles(surface, faces, creases);
}

TEST(CreaseBound, SectorsOfACornerKeepTheirOwnAngles) {
  const test::Triangles cube = test::cube();
  const Adjacency c = test::connect(cube);
  const MeasuredSurface surface(cube.points, c);
  const auto is_above_45 = [](const AngleBound& b) { return b.degrees > 46; };
  EXPECT_TRUE(std::ranges::any_of(bounds_between({}, surface),
                                  is_above_45));  // corners have five faces, of 270 degrees in all
  const std::vector<Edge> creases = edges_of_cube(cube);
  ASSERT_EQ(creases.size(), 12u);
  for (const AngleBound& b : bounds_between(creases, surface)) {
    EXPECT_NEAR(b.degrees, 45, 1e-2);
    EXPECT_FALSE(b.vertices.empty());
  }
}

/// A narrow face between a crease and the boundary, on a roof: what crosses the crease takes nothing from it.
test::Triangles roof() {
  return test::triangles({{0, 0, 0}, {1, 0, 0}, {1, .3, 0}, {1, -.5, -1}, {0, -1, -1}},
                         {{0, 1, 2}, {0, 3, 1}, {0, 4, 3}});
}

TEST(CreaseBound, AFaceAloneInItsSectorHasItsAngle) {
  const test::Triangles t = roof();
  const Adjacency c = test::connect(t);
  const AngleBound narrow = bounds_between({{1, 0}}, MeasuredSurface(t.points, c))[0];
  EXPECT_NEAR(narrow.degrees, std::atan(.3) * 180 / std::numbers::pi, 1e-9);
  EXPECT_EQ(narrow.vertices, std::vector<int>{0});
}

TEST(CreaseBound, SpeaksInTheIdsOfTheSurface) {
  const test::Triangles t = roof();
  const Adjacency c = test::connect(t);
  const std::vector<int> vertices = {4, 3, 2, 1, 0}, faces_there = {2, 0, 1};
  const AngleBound narrow =
      bounds_between({{0, 1}}, MeasuredSurface(t.points, c, {vertices, faces_there}))[2];
  EXPECT_NEAR(narrow.degrees, std::atan(.3) * 180 / std::numbers::pi, 1e-9);
  EXPECT_EQ(narrow.vertices, std::vector<int>{4});
}

}  // namespace hooke::angle_bound_test
