#include "hooke/springs/placed_lengths.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "support/solids.h"

namespace hooke::placed_lengths_test {

constexpr double rounded_down = .91, no_limit = std::numeric_limits<double>::infinity();
const Vec3 a(1, 0, 0), b(3, 0, 0);

TEST(PlacedLengths, HoldAlongTheirSegments) {
  const PlacedLengths placed({{a, b, .7}, {b, b, .2}}, 1, .3);
  EXPECT_FALSE(placed.empty());
  for (const Vec3& x : {a, Vec3(1.4, 0, 0)}) {
    EXPECT_LE(placed.length_at(x, 5), .7);
    EXPECT_GE(placed.length_at(x, 5), .7 * rounded_down);
  }
  EXPECT_LE(placed.length_at(b, 5), .2);
  EXPECT_GE(placed.length_at(b, 5), .2 * rounded_down);
}

TEST(PlacedLengths, GrowAsTheGradationSaysUpToWhatIsAsked) {
  for (double gradation : {.1, .3, 1.}) {
    const PlacedLengths placed({{a, b, .7}, {Vec3(0, 4, 1), Vec3(0, 4, 1), .3}}, 1, gradation);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> u(-6, 6);
    for (int i = 0; i < 200; ++i) {
      const Vec3 x(u(random), u(random), u(random)), y(u(random), u(random), u(random));
      const double lx = placed.length_at(x, 2), ly = placed.length_at(y, 2);
      EXPECT_LE(std::abs(lx - ly), gradation * (x - y).norm() + 1e-12);
      EXPECT_LE(lx, 2);
    }
    EXPECT_NEAR(placed.length_at({2, -.7, 0}, 2) - placed.length_at({2, -.4, 0}, 2), .3 * gradation, 1e-12);
    EXPECT_EQ(placed.length_at({2, -25, 0}, 2), 2);
    EXPECT_EQ(placed.length_at(a, .1), .1);
  }
}

TEST(PlacedLengths, NoneAskForNothing) {
  EXPECT_TRUE(PlacedLengths().empty());
  EXPECT_TRUE(PlacedLengths({}, 1, .3).empty());
  EXPECT_EQ(PlacedLengths({}, 1, .3).length_at(Vec3::Zero(), 5), 5);
}

TEST(PlacedLengths, AreThoseBeforeWhereOthersAreAdded) {
  std::vector<PlacedLength> places{{a, b, .7}};
  const PlacedLengths before(places, .9, .3);
  const Vec3 far(5, 0, 0);
  places.push_back({far, far, .013});
  const PlacedLengths after(places, .9, .3);
  EXPECT_EQ(before.length_at({0, .2, 0}, 5), after.length_at({0, .2, 0}, 5));
  EXPECT_LT(after.length_at({5, .2, 0}, 5), before.length_at({5, .2, 0}, 5));
}

TEST(PlacedLengths, FacesAreCountedAsTheirLengthsAsk) {
  const test::Triangles square =
      test::triangles({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
  const double area = 1, per_face = std::sqrt(3.) / 4;
  const std::vector<double> short_ones(square.points.cols(), .05), long_ones(square.points.cols(), 5);
  const double uniform = PlacedLengths().covering_faces(square.points, square.faces, short_ones, no_limit);
  EXPECT_NEAR(uniform, area / (per_face * .05 * .05), 1e-6 * uniform);
  const Vec3 corner = square.points.col(0), opposite = corner + Vec3(1, 1, 0);
  const PlacedLengths diagonal({{corner, opposite, .1}}, .1, 1e-6);
  const double placed = diagonal.covering_faces(square.points, square.faces, long_ones, no_limit);
  EXPECT_NEAR(placed, area / (per_face * .1 * .1), 1e-3 * placed);
  EXPECT_LT(diagonal.covering_faces(square.points, square.faces, long_ones, 10), placed);
  EXPECT_GT(diagonal.covering_faces(square.points, square.faces, long_ones, 10), 10);
}

/// Ten million lengths long, and narrower than they are: few pieces tell how many faces it takes.
TEST(PlacedLengths, FacesOfANeedleAreCountedInFewPieces) {
  const test::Triangles needle = test::triangles({{0, 0, 0}, {1e6, 0, 0}, {1e6, 1e-3, 0}}, {{0, 1, 2}});
  const std::vector<double> asked(3, 10);
  const PlacedLengths placed({{Vec3::Zero(), Vec3(1e6, 0, 0), .1}}, 1, .3);
  const double faces = placed.covering_faces(needle.points, needle.faces, asked, no_limit);
  EXPECT_NEAR(faces, .5 * 1e6 * 1e-3 / (std::sqrt(3.) / 4 * .1 * .1), .25 * faces);
}

}  // namespace hooke::placed_lengths_test
