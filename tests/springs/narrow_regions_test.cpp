#include "hooke/springs/narrow_regions.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "hooke/mesh/normals.h"
#include "hooke/mesh/wedges.h"
#include "support/solids.h"

namespace hooke::narrow_regions_test {

using test::Triangles;

constexpr double rounded_down = .91;

/// All sharp edges are creases.
PlacedLengths regions_of(const Triangles& t, double asked, double shortest, double gradation = .3) {
  Adjacency c = test::connect(t);
  std::vector<Edge> creases;
  for (int e : sharp_edges(t.points, c, 40)) creases.push_back(c.edges[e]);
  split_wedges(c, creases);
  const std::vector<double> lengths(c.vertex_count, asked);
  return {lengths_of_narrow_regions(t.points, c, lengths, shortest), shortest, gradation};
}

/// In the plane, with this many edges on both long sides.
Triangles strip(double length, double width, int pieces) {
  Triangles t{Mat3X(3, 2 * (pieces + 1)), {}};
  for (int i = 0; i <= pieces; ++i) {
    t.points.col(2 * i) = Vec3(length * i / pieces, 0, 0);
    t.points.col(2 * i + 1) = Vec3(length * i / pieces, width, 0);
  }
  for (int i = 0; i < 2 * pieces; i += 2) {
    t.faces.push_back({i, i + 2, i + 3});
    t.faces.push_back({i, i + 3, i + 1});
  }
  return t;
}

/// A regular polygon with a vertex in the middle.
Triangles disc(int sides, double radius) {
  Triangles t{Mat3X::Zero(3, sides + 1), {}};
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    t.points.col(i) = radius * Vec3(std::cos(angle), std::sin(angle), 0);
    t.faces.push_back({i, (i + 1) % sides, sides});
  }
  return t;
}

Triangles box(double x, double y, double z) {
  Triangles t = test::cube();
  const Vec3 low = t.points.rowwise().minCoeff(), size = t.points.rowwise().maxCoeff() - low;
  t.points = (Vec3(x, y, z).cwiseQuotient(size).asDiagonal() * (t.points.colwise() - low)).eval();
  return t;
}

TEST(NarrowRegions, EdgesFitAcrossAStripHoweverItIsCut) {
  for (int pieces : {1, 7, 60}) {
    const PlacedLengths regions = regions_of(strip(40, 1, pieces), 5, .01);
    for (double x : {4., 11.3, 20., 33.})
      for (double y : {0., 1.}) {
        EXPECT_LE(regions.length_at({x, y, 0}, 5), 1) << pieces << ' ' << x;
        EXPECT_GE(regions.length_at({x, y, 0}, 5), rounded_down) << pieces << ' ' << x;
      }
  }
}

TEST(NarrowRegions, NoLengthIsBelowTheShortest) {
  const PlacedLengths regions = regions_of(strip(40, 1, 3), 5, 2);
  EXPECT_EQ(regions.length_at({20, 0, 0}, 5), 2);
}

TEST(NarrowRegions, CreasesBoundRegionsAsBoundariesDo) {
  const PlacedLengths regions = regions_of(box(40, 1, 30), 5, .01);
  for (const Vec3& on_narrow_side : {Vec3(20, .5, 0), Vec3(0, .5, 15), Vec3(20, 0, 30)})
    EXPECT_NEAR(regions.length_at(on_narrow_side, 5), 1 - .5 * (1 - rounded_down),
                .5 * (1 - rounded_down) + .15);
  EXPECT_EQ(regions.length_at({20, 0, 15}, 5), 5);
}

TEST(NarrowRegions, CornersAndDiscsAreNone) {
  EXPECT_TRUE(regions_of(strip(6, 6, 9), 5, .01).empty());
  EXPECT_TRUE(regions_of(box(6, 6, 6), 5, .01).empty());
  EXPECT_TRUE(regions_of(disc(60, 6), 5, .01).empty());
  EXPECT_TRUE(regions_of(test::sphere(2), 5, .01).empty());  // no rims at all
}

TEST(NarrowRegions, ASmallDiscIsAsWideAsItsRadius) {
  const PlacedLengths regions = regions_of(disc(60, 2), 5, .01);
  EXPECT_LE(regions.length_at({2, 0, 0}, 5), 2);
  EXPECT_GE(regions.length_at({2, 0, 0}, 5), rounded_down * 1.99);
}

TEST(NarrowRegions, KinksAndJaggedRimsAreNotRound) {
  Triangles kinked = strip(40, 12, 80);
  for (int i = 80; i <= 160; ++i) {
    const int column = i / 2;
    kinked.points.col(i) += Vec3(0, .2 * (column - 40) * .5, 0);  // a turn of 11 degrees
  }
  EXPECT_TRUE(regions_of(kinked, 5, .01).empty());
  std::mt19937 random(2);
  std::uniform_real_distribution<double> noise(-.05, .05);
  Triangles jagged = strip(40, 12, 80);
  for (auto x : jagged.points.colwise()) x += Vec3(0, noise(random), 0);
  EXPECT_TRUE(regions_of(jagged, 5, .01).empty());
  for (int sides : {6, 8, 12}) EXPECT_FALSE(regions_of(disc(sides, 2), 5, .01).empty()) << sides;
}

TEST(NarrowRegions, LengthsScaleWithTheMesh) {
  const Triangles t = box(40, 1, 30);
  Triangles twice = t;
  twice.points *= 2;
  const PlacedLengths regions = regions_of(t, 5, .01), larger = regions_of(twice, 10, .02);
  for (double z = 0; z < 10; z += .37)
    EXPECT_EQ(larger.length_at({40, 0, 2 * z}, 10), 2 * regions.length_at({20, 0, z}, 5)) << z;
}

}  // namespace hooke::narrow_regions_test
