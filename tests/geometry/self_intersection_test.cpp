#include "hooke/geometry/self_intersection.h"

#include <gtest/gtest.h>

#include <cmath>

#include "hooke/core/parallel.h"
#include "support/crease_solids.h"
#include "support/solids.h"

namespace hooke::self_intersection_test {

using Pairs = std::vector<std::array<int, 2>>;

size_t count(const test::Triangles& t) {
  return find_self_intersections(t.points, t.faces).size();
}

/// The same faces in every turn, so that each role is played by each corner.
void expect_pair(const test::Triangles& t, bool meets) {
  ASSERT_EQ(t.faces.size(), 2u);
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j)
      for (bool swapped : {false, true}) {
        const auto turn = [](const Triangle& f, size_t k) {
          return Triangle{f[k], f[(k + 1) % 3], f[(k + 2) % 3]};
        };
        std::vector<Triangle> faces = {turn(t.faces[0], i), turn(t.faces[1], j)};
        if (swapped) std::swap(faces[0], faces[1]);
        const Pairs pairs = find_self_intersections(t.points, faces);
        EXPECT_EQ(pairs, meets ? Pairs({{0, 1}}) : Pairs()) << i << j << swapped;
      }
}

const Vec3 a(0, 0, 0), b(4, 0, 0), c(0, 4, 0);  // the first triangle of most cases

test::Triangles apart(const Vec3& p, const Vec3& q, const Vec3& r) {
  return test::triangles({a, b, c, p, q, r}, {{0, 1, 2}, {3, 4, 5}});
}
test::Triangles sharing_corner(const Vec3& q, const Vec3& r) {
  return test::triangles({a, b, c, q, r}, {{0, 1, 2}, {0, 3, 4}});
}
test::Triangles sharing_edge(const Vec3& r) {
  return test::triangles({a, b, c, r}, {{0, 1, 2}, {1, 0, 3}});
}

TEST(SelfIntersection, TrianglesWithoutACommonVertex) {
  expect_pair(apart({1, 1, -1}, {1, 1, 1}, {9, 9, 0}), true);    // an edge pierces the inside
  expect_pair(apart({1, 1, 0}, {1, 1, 3}, {2, 2, 3}), true);     // a corner touches the inside
  expect_pair(apart({0, 0, 0}, {-1, 0, 1}, {0, -1, 1}), true);   // corner on corner, different ids
  expect_pair(apart({2, 0, 0}, {2, -1, 1}, {2, -1, 2}), true);   // a corner touches an edge
  expect_pair(apart({2, -1, -1}, {2, 1, 1}, {2, -9, 9}), true);  // edge through edge's plane, inside
  expect_pair(apart({0, 0, 0}, {4, 0, 0}, {2, -1, 1}), true);    // edge on edge, different ids
  expect_pair(apart({1, 1, 1}, {2, 1, 1}, {1, 2, 1}), false);    // parallel above
  expect_pair(apart({3, 3, -1}, {3, 3, 1}, {9, 9, 0}), false);   // crosses the plane outside
  expect_pair(apart({-1, -1, -1}, {-1, -1, 1}, {-2, 0, 0}), false);
}

TEST(SelfIntersection, InOnePlane) {
  expect_pair(apart({1, 1, 0}, {9, 1, 0}, {9, 9, 0}), true);  // overlap
  expect_pair(apart({1, 1, 0}, {2, 1, 0}, {1, 2, 0}), true);  // one inside the other
  expect_pair(apart({-9, -9, 0}, {20, -9, 0}, {-9, 20, 0}), true);
  expect_pair(apart({2, 2, 0}, {5, 5, 0}, {5, 4, 0}), true);  // a corner touches an edge
  expect_pair(apart({4, 0, 0}, {0, 4, 0}, {5, 5, 0}), true);  // edge on edge
  expect_pair(apart({3, 3, 0}, {5, 5, 0}, {5, 4, 0}), false);
  expect_pair(apart(a, b, c), true);  // identical positions
}

TEST(SelfIntersection, TrianglesWithACommonVertex) {
  expect_pair(sharing_corner({1, 1, 1}, {1, 1, 2}), false);       // touch there only
  expect_pair(sharing_corner({2, 1, 1}, {1, 2, -1}), true);       // pierces from the corner inward
  expect_pair(sharing_corner({-2, -1, 1}, {-1, -2, -1}), false);  // crosses the plane on the far side
  expect_pair(sharing_corner({2, 0, 0}, {2, -1, 1}), true);       // an edge lies on an edge
  expect_pair(sharing_corner({1, 1, 0}, {1, 1, 1}), true);        // an edge lies on the face
  expect_pair(sharing_corner({-1, 0, 0}, {0, -1, 0}), false);     // in one plane, opposite sectors
  expect_pair(sharing_corner({1, 1, 0}, {-1, 2, 0}), true);       // in one plane, sectors overlap
  expect_pair(sharing_corner({8, 1, 0}, {1, 8, 0}), true);
  expect_pair(sharing_corner({1, 2, 0}, {2, 1, 0}), true);
  expect_pair(sharing_corner({0, 0, 5}, {9, 9, 5}), false);
}

TEST(SelfIntersection, TrianglesWithACommonEdge) {
  expect_pair(sharing_edge({0, -4, 0}), false);  // flat, side by side
  expect_pair(sharing_edge({1, 1, 0}), true);    // folded shut
  expect_pair(sharing_edge({1, 1, 1e-300}), false);
  expect_pair(sharing_edge({1, 1, 1}), false);
}

TEST(SelfIntersection, SegmentIsWhatBothTrianglesShare) {
  const std::array<Vec3, 3> flat = {a, b, c}, upright = {Vec3(1, -1, -1), Vec3(1, -1, 3), Vec3(1, 3, -1)};
  for (const auto& [from, to] : {crossing_segment(flat, upright), crossing_segment(upright, flat)}) {
    const auto [low, high] =
        std::minmax(from, to, [](const Vec3& p, const Vec3& q) { return p.y() < q.y(); });
    EXPECT_LT((low - Vec3(1, 0, 0)).norm(), 1e-12);
    EXPECT_LT((high - Vec3(1, 2, 0)).norm(), 1e-12);
  }
  const auto [from, to] = crossing_segment(flat, {Vec3(1, 1, 0), b, c});  // in one plane
  EXPECT_EQ(from, to);
  EXPECT_NEAR(from.z(), 0, 1e-12);
}

TEST(SelfIntersection, SegmentOfTrianglesThatTouchIsAPointOfBoth) {
  const std::array<Vec3, 3> ground = {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};
  const std::array<std::array<Vec3, 3>, 4> others = {{
      {Vec3(1, 1, 1e-17), Vec3(2, 1, 1e-17), Vec3(1, 1, 9)},  // stands on it
      {Vec3(2, 2, -1e-17), Vec3(9, 9, 0), Vec3(9, 9, 9)},     // at its edge
      {Vec3(3, -2, 0), Vec3(3, .5, 1e-17), Vec3(9, -2, 0)},   // in its plane
      {Vec3(-3, 1, 0), Vec3(9, 1, 0), Vec3(9, 1.5, 0)},       // across it
  }};
  for (const std::array<Vec3, 3>& other : others)
    for (const auto& [from, to] : {crossing_segment(ground, other), crossing_segment(other, ground)})
      for (const Vec3& x : {from, to}) {
        EXPECT_LT(closest_point(x, ground[0], ground[1], ground[2]).squared_distance, 1e-24);
        EXPECT_LT(closest_point(x, other[0], other[1], other[2]).squared_distance, 1e-24);
      }
}

TEST(SelfIntersection, SameThreeVerticesAreNoPair) {
  EXPECT_EQ(count(test::triangles({a, b, c}, {{0, 1, 2}, {0, 2, 1}})), 0u);
}

TEST(SelfIntersection, FacesWithoutAreaAreLeftOut) {
  expect_pair(apart({1, 1, -1}, {1, 1, 0}, {1, 1, 1}), false);
  expect_pair(apart({1, 1, -1}, {1, 1, -1}, {1, 1, 1}), false);
}

TEST(SelfIntersection, CleanMeshesHaveNone) {
  EXPECT_EQ(count(test::cube()), 0u);
  EXPECT_EQ(count(test::tetrahedron()), 0u);
  EXPECT_EQ(count(test::sphere(4, .3)), 0u);
  EXPECT_EQ(count(test::grid(20, test::flat, .3)), 0u);
  EXPECT_EQ(count(test::moved(test::grid(20, test::flat, .2))), 0u);  // nearly in one plane, after rounding
  EXPECT_EQ(count(test::both(test::cube(), test::moved(test::cube(), 9))), 0u);
}

/// All pairs of faces, each by itself.
Pairs pair_by_pair(const test::Triangles& t) {
  Pairs pairs;
  for (int f = 0; f < static_cast<int>(t.faces.size()); ++f)
    for (int g = f + 1; g < static_cast<int>(t.faces.size()); ++g)
      if (!find_self_intersections(t.points, {t.faces[f], t.faces[g]}).empty()) pairs.push_back({f, g});
  return pairs;
}

TEST(SelfIntersection, NeedlesOfCapsAndFansAreNoExceptions) {
  const test::Triangles drum = test::drum(100, .5), cone = test::pyramid(120, 1, .5),
                        disc = test::pyramid(120, 1, 0);  // its two sides lie on each other
  EXPECT_EQ(count(drum), 0u);
  EXPECT_EQ(count(cone), 0u);
  EXPECT_EQ(count(test::moved(drum)), 0u);
  EXPECT_EQ(count(test::moved(cone)), 0u);
  for (const test::Triangles& t : {drum, cone, disc})
    for (const test::Triangles& tried : {t, test::shaken(t, .003), test::moved(test::shaken(t, .01))})
      EXPECT_EQ(find_self_intersections(tried.points, tried.faces), pair_by_pair(tried));
}

TEST(SelfIntersection, DuplicateGeometryMeetsItself) {
  const test::Triangles cube = test::cube();
  // 12 faces on their copies; for each, the copies of all faces that touch it.
  size_t expected = 0;
  for (const Triangle& f : cube.faces)
    for (const Triangle& g : cube.faces) {
      const auto in_g = [&](int v) { return v == g[0] || v == g[1] || v == g[2]; };
      expected += in_g(f[0]) || in_g(f[1]) || in_g(f[2]);
    }
  EXPECT_EQ(count(test::both(cube, cube)), expected);
}

TEST(SelfIntersection, MovingAlongAnExactStepChangesNothing) {
  const test::Triangles t = test::shaken(test::sphere(3), .2);
  test::Triangles scaled = t;
  scaled.points *= 1024;
  EXPECT_GT(count(t), 100u);
  EXPECT_EQ(find_self_intersections(t.points, t.faces), find_self_intersections(scaled.points, scaled.faces));
}

TEST(SelfIntersection, PairsAreOrderedAndEqualForAnyNumberOfThreads) {
  const test::Triangles t = test::shaken(test::sphere(4), .1);
  const Pairs many = find_self_intersections(t.points, t.faces);
  const ThreadLimit one(1);
  EXPECT_EQ(find_self_intersections(t.points, t.faces), many);
  EXPECT_TRUE(std::is_sorted(many.begin(), many.end()));
  for (const auto& [f, g] : many) EXPECT_LT(f, g);
}

}  // namespace hooke::self_intersection_test
