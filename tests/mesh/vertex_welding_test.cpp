#include "hooke/mesh/vertex_welding.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "support/meshes.h"
#include "support/solids.h"

namespace hooke::vertex_welding_test {

Mat3X on_a_line(const std::vector<double>& x) {
  Mat3X points = Mat3X::Zero(3, static_cast<Eigen::Index>(x.size()));
  for (size_t k = 0; k < x.size(); ++k) points(0, static_cast<Eigen::Index>(k)) = x[k];
  return points;
}

TEST(VertexWelding, NoReachJoinsEqualCoordinatesOnly) {
  const Mat3X points = on_a_line({0, 1, -0., 1, std::nextafter(1, 2), 1e300, 1e300});
  EXPECT_EQ(weld_vertices(points, std::vector(7, 0.)), (std::vector{0, 1, 0, 1, 4, 5, 5}));
  EXPECT_EQ(weld_vertices(points, std::vector(7, -1.)), (std::vector{0, 1, 2, 3, 4, 5, 6}));
}

TEST(VertexWelding, EachGoesToTheClosestThatStays) {
  EXPECT_EQ(weld_vertices(on_a_line({0, .9, 1.8, 1.2}), std::vector(4, 1.)), (std::vector{0, 0, 2, 2}));
  EXPECT_EQ(weld_vertices(on_a_line({0, 2, 1}), std::vector(3, 1.)), (std::vector{0, 1, 0}))
      << "the first of two";
}

TEST(VertexWelding, BothMustReach) {
  EXPECT_EQ(weld_vertices(on_a_line({0, .5, 1}), {1, .4, 1}), (std::vector{0, 1, 0}));
}

TEST(VertexWelding, IsAsIfAllPairsWereCompared) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-1, 1), radius(-.02, .15);
  Mat3X points(3, 400);
  for (double& x : points.reshaped()) x = coordinate(random);
  std::vector<double> reach(400);
  for (double& r : reach) r = radius(random);
  std::vector<int> expected(400);
  for (int v = 0; v < 400; ++v) {
    const auto at = static_cast<size_t>(v);
    expected[at] = v;
    double least = std::numeric_limits<double>::infinity();
    for (int w = 0; w < v; ++w) {
      const double distance = (points.col(v) - points.col(w)).norm();
      if (expected[w] != w || distance >= least) continue;
      if (distance > std::min(reach[at], reach[w])) continue;
      least = distance;
      expected[at] = w;
    }
  }
  EXPECT_EQ(weld_vertices(points, reach), expected);
}

TEST(VertexWelding, OnlyBoundariesReach) {
  const test::Triangles closed = test::sphere(1), open = test::grid(2, test::flat);
  for (const double r : reach_of_boundary(closed.points, closed.faces)) EXPECT_EQ(r, -1);
  const std::vector<double> reach = reach_of_boundary(open.points, open.faces);
  for (int v = 0; v < 9; ++v) EXPECT_EQ(reach[v], v == 4 ? -1 : .5 * welding_share);
}

/// Two unit squares of n x n and m x m cells side by side, with a gap between them.
test::Triangles squares(int n, int m, double gap) {
  test::Triangles right = test::grid(m, test::flat);
  right.points.row(0).array() += 1 + gap;
  return test::both(test::grid(n, test::flat), right);
}

TEST(Cracks, AreTJunctionsAndNarrowGaps) {
  const auto cracks = [](const test::Triangles& t) {
    return vertices_at_cracks(t.points, test::connect(t)).size();
  };
  EXPECT_EQ(cracks(squares(4, 8, 0)), 4u) << "in the middle of the longer edges";
  EXPECT_EQ(cracks(squares(4, 3, 0)), 3u + 2u);
  EXPECT_EQ(cracks(squares(4, 4, .002)), 8u) << "both sides, but for two corners at which faces end";
  EXPECT_EQ(cracks(squares(4, 4, 0)), 0u) << "vertices in the same places";
  EXPECT_EQ(cracks(squares(4, 4, 1e-5)), 0u) << "vertices that are merged";
  EXPECT_EQ(cracks(squares(4, 8, .01)), 0u) << "too far";
  EXPECT_EQ(cracks(test::cube()), 0u);
}

TEST(Cracks, AreFoundWhicheverWayFacesAreTurned) {
  test::Triangles t = squares(4, 8, 0);
  for (size_t f = 0; f < 32; ++f) std::swap(t.faces[f][1], t.faces[f][2]);
  EXPECT_EQ(vertices_at_cracks(t.points, test::connect(t)).size(), 4u);
}

TEST(Cracks, AreNotTheSidesOfANarrowStrip) {
  test::Triangles t = test::grid(4, test::flat);
  t.points.row(1) *= .005;
  EXPECT_TRUE(vertices_at_cracks(t.points, test::connect(t)).empty());
}

TEST(Cracks, AreNotTheShortEdgesOfABoundary) {
  const test::Triangles t = test::triangles(
      {{0, 0, 0}, {1, 0, 0}, {1.002, .002, 0}, {1.002, 1, 0}, {.5, 1, 0}}, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}});
  EXPECT_TRUE(vertices_at_cracks(t.points, test::connect(t)).empty());
}

}  // namespace hooke::vertex_welding_test
