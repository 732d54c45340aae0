#include "hooke/constraints/rounded_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "support/crease_solids.h"
#include "support/solids.h"

namespace hooke::rounded_edges_test {

const Vec3 half(20, 15, 6);
constexpr double radius = 1, sharp_angle = 40;

/// As pairs of points, ascending.
using Segments = std::vector<std::array<double, 6>>;

Segments middles_of(const test::Triangles& t, double length, double angle = sharp_angle) {
  const Adjacency c = test::connect(t);
  Segments segments;
  for (const auto& [v, w] : middles_of_rounded_edges(t.points, c, std::vector<double>(c.edges.size(), length),
                                                     angle, std::vector<char>(c.edges.size(), 0))) {
    std::array<double, 6> s;
    for (int k = 0; k < 3; ++k) {
      s[k] = t.points(k, v);
      s[k + 3] = t.points(k, w);
    }
    if (std::lexicographical_compare(s.begin() + 3, s.end(), s.begin(), s.begin() + 3))
      std::rotate(s.begin(), s.begin() + 3, s.end());
    segments.push_back(s);
  }
  std::ranges::sort(segments);
  return segments;
}

/// How the point is turned from the centre of the rounding.
Vec3 turn_at(const Vec3& x) {
  Vec3 turn = x;
  for (int k = 0; k < 3; ++k) turn[k] = std::max(0., std::abs(x[k]) - (half[k] - radius));
  return turn / radius;
}

TEST(RoundedEdges, OfABoxAreTwelveThatMeetAtItsEightCorners) {
  constexpr int steps = 3;
  const Segments lines = middles_of(test::rounded_box(half, radius, steps), 8 * radius);
  EXPECT_EQ(lines.size(), 12u + 8 * 3 * steps);  // one along each, and from its ends to the corners
  std::map<std::array<double, 3>, int> ends;
  for (const auto& s : lines) {
    ++ends[{s[0], s[1], s[2]}];
    ++ends[{s[3], s[4], s[5]}];
  }
  for (const auto& [x, count] : ends) {
    Vec3 turn = turn_at({x[0], x[1], x[2]});
    std::ranges::sort(turn, std::greater());
    EXPECT_NEAR(turn[0], turn[1], 1e-9) << "is not in the middle between two sides";
    EXPECT_EQ(count, turn[1] - turn[2] < 1e-9 ? 3 : 2);
  }
}

TEST(RoundedEdges, AreNoneThatTheLengthsFollow) {
  const test::Triangles box = test::rounded_box(half, radius, 3);
  EXPECT_TRUE(middles_of(box, radius).empty());
  EXPECT_FALSE(middles_of(box, 2 * radius).empty());
}

TEST(RoundedEdges, AreNoneWhereSidesTurnLessThanTheSharpAngle) {
  EXPECT_TRUE(middles_of(test::rounded_box(half, radius, 3), 8, 91).empty());
}

TEST(RoundedEdges, AreNoneOfASphereOrATorus) {
  EXPECT_TRUE(middles_of(test::globe(40, 20), 8).empty());
  EXPECT_TRUE(middles_of(test::torus(60, 24, 0), .2).empty());
}

TEST(RoundedEdges, AreTheSameHoweverVerticesAreNumbered) {
  const test::Triangles box = test::rounded_box(half, radius, 4);
  EXPECT_EQ(middles_of(test::shuffled(box), 8), middles_of(box, 8));
}

TEST(RoundedEdges, EndAtCreases) {
  const test::Triangles box = test::rounded_box(half, radius, 3);
  const Adjacency c = test::connect(box);
  EXPECT_TRUE(middles_of_rounded_edges(box.points, c, std::vector<double>(c.edges.size(), 8.), sharp_angle,
                                       std::vector<char>(c.edges.size(), 1))
                  .empty());
}

}  // namespace hooke::rounded_edges_test
