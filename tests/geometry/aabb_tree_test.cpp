#include "hooke/geometry/aabb_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <random>
#include <set>

#include "support/crease_solids.h"
#include "support/solids.h"

namespace hooke::aabb_tree_test {

TEST(AabbTree, AFaceIsWithinADistanceIfTheClosestIs) {
  const test::Triangles t = test::sphere(3, .3, 1);
  const AabbTree tree(t.points, t.faces);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(-2, 2);
  for (int i = 0; i < 500; ++i) {
    Vec3 x;
    for (double& coordinate : x) coordinate = u(random);
    const double distance = std::sqrt(tree.closest(x).squared_distance);
    EXPECT_TRUE(tree.has_face_within(1.001 * distance, x));
    EXPECT_FALSE(tree.has_face_within(.999 * distance, x));
    const auto is_even = [](int f) { return f % 2 == 0; };
    const double of_even = std::sqrt(tree.closest(x, is_even).squared_distance);
    EXPECT_TRUE(tree.has_face_within(1.001 * of_even, x, is_even));
    EXPECT_FALSE(tree.has_face_within(.999 * of_even, x, is_even));
  }
  EXPECT_FALSE(AabbTree(t.points, {}).has_face_within(1e9, Vec3::Zero()));
}

TEST(AabbTree, ClosestPointEqualsBruteForce) {
  const test::Triangles t = test::shaken(test::sphere(2), .1);
  const AabbTree tree(t.points, t.faces);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-2, 2);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 x(u(random), u(random), u(random));
    ClosestPoint best;
    for (size_t f = 0; f < t.faces.size(); ++f) {
      const auto& [a, b, c] = t.faces[f];
      const ClosestPoint p = closest_point(x, t.points.col(a), t.points.col(b), t.points.col(c));
      if (p.squared_distance >= best.squared_distance) continue;
      best = p;
      best.face = static_cast<int>(f);
    }
    const ClosestPoint found = tree.closest(x);
    ASSERT_EQ(found.squared_distance, best.squared_distance);
    ASSERT_EQ(found.point, best.point);
  }
}

/// A flat round cap whose needles meet at its centre, turned out of the axes or not.
test::Triangles round_cap(int sides, bool turned) {
  test::Triangles t = test::pyramid(sides, 1, 0);
  t.faces.resize(sides);
  std::ranges::generate(t.faces, [f = 0, sides]() mutable {
    const int at = f++;
    return Triangle{at, (at + 1) % sides, sides};
  });
  return turned ? test::moved(t) : t;
}

TEST(AabbTree, FewNeedlesOfAFanAreTestedForAPoint) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> u(0, 1);
  for (bool turned : {false, true})
    for (int sides : {1000, 8000}) {
      const test::Triangles t = round_cap(sides, turned);
      const AabbTree tree(t.points, t.faces);
      EXPECT_FALSE(tree.slabs().empty());
      int tested = 0;
      for (int i = 0; i < 100; ++i) {
        const int f = static_cast<int>(u(random) * sides);
        const auto& [a, b, c] = t.faces[f];
        const double height = .01 * u(random), share = .2 + .8 * u(random);
        const Vec3 hub = t.points.col(c), rim = .5 * (t.points.col(a) + t.points.col(b)),
                   up = (t.points.col(a) - hub).cross(t.points.col(b) - hub).normalized(),
                   x = hub + share * (rim - hub) + height * up;
        const ClosestPoint found = tree.closest(x, [&](int) { return ++tested > 0; });
        EXPECT_NEAR(found.squared_distance, height * height, 1e-12);
      }
      EXPECT_LT(tested, 100 * 100) << sides;
    }
}

TEST(AabbTree, SlabsChangeNoAnswer) {
  const test::Triangles cone = test::pyramid(400, 1, .5), cap = round_cap(500, true);
  std::mt19937 random(8);
  std::uniform_real_distribution<double> u(-1.5, 1.5);
  for (const test::Triangles& t : {cone, cap, test::shaken(cap, .01)}) {
    const AabbTree tree(t.points, t.faces);
    EXPECT_FALSE(tree.slabs().empty());
    for (int i = 0; i < 300; ++i) {
      Vec3 x(u(random), u(random), u(random));
      if (i % 3 == 0) x = t.points.col(i);
      double least = std::numeric_limits<double>::infinity();
      for (const auto& [a, b, c] : t.faces)
        least = std::min(
            least, closest_point(x, t.points.col(a), t.points.col(b), t.points.col(c)).squared_distance);
      ASSERT_EQ(tree.closest(x).squared_distance, least);
    }
  }
  const test::Triangles round = test::sphere(4, .3);
  EXPECT_TRUE(AabbTree(round.points, round.faces).slabs().empty());
}

TEST(AabbTree, AKnownPointOnlyShortensTheSearch) {
  const test::Triangles t = test::shaken(test::sphere(2), .1);
  const AabbTree tree(t.points, t.faces);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> u(-2, 2);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 x(u(random), u(random), u(random));
    int visited = 0, visited_with = 0;
    const auto accepts = [i](int f) { return f % 7 == i % 7; };
    const auto count = [&](int& tests) {
      return [&](int f) {
        ++tests;
        return accepts(f);
      };
    };
    const ClosestPoint found = tree.closest(x, count(visited));
    ClosestPoint known;
    const int face = i % 7 + 7 * (i % 40);
    const auto& [a, b, c] = t.faces[face];
    update_closest(x, {t.points.col(a), t.points.col(b), t.points.col(c)}, face, known);
    const ClosestPoint with = tree.closest(x, count(visited_with), known);
    ASSERT_TRUE(accepts(found.face));
    ASSERT_EQ(with.face, found.face);
    ASSERT_EQ(with.point, found.point);
    ASSERT_LE(visited_with, visited);
  }
}

TEST(AabbTree, PointOnAVertexHasDistanceZero) {
  const test::Triangles t = test::sphere(3, .2);
  const AabbTree tree(t.points, t.faces);
  for (Eigen::Index v = 0; v < t.points.cols(); ++v)
    EXPECT_LT(tree.closest(t.points.col(v)).squared_distance, 1e-30);
}

TEST(AabbTree, PairsOfBoxesThatMeetAreAllVisitedOnce) {
  const test::Triangles t = test::shaken(test::sphere(2), .3);
  const AabbTree tree(t.points, t.faces);
  using Face = AabbTree::Face;
  std::multiset<std::array<int, 2>> visited, expected;
  const auto visit = [&](const Face& f, const Face& g) {
    visited.insert({std::min(f.id, g.id), std::max(f.id, g.id)});
  };
  const size_t half = tree.parts() / 2;  // parts may be asked for in any grouping
  tree.for_each_overlapping_pair(half, tree.parts(), visit);
  tree.for_each_overlapping_pair(0, half, visit);
  for (const Face& f : tree.faces())
    for (const Face& g : tree.faces())
      if (f.id < g.id && f.box().intersects(g.box())) expected.insert({f.id, g.id});
  EXPECT_EQ(visited, expected);
}

TEST(AabbTree, FacesInItsOrderAreThoseItWasMadeOf) {
  const test::Triangles t = test::sphere(3, .2);
  const AabbTree tree(t.points, t.faces);
  ASSERT_EQ(tree.faces().size(), t.faces.size());
  std::set<int> ids;
  for (const AabbTree::Face& face : tree.faces()) {
    ids.insert(face.id);
    EXPECT_EQ(face.vertices, t.faces[face.id]);
    for (size_t k = 0; k < 3; ++k) EXPECT_EQ(face.corners[k], t.points.col(face.vertices[k]));
  }
  EXPECT_EQ(ids.size(), t.faces.size());
}

TEST(AabbTree, OrderOfFacesCanBeGivenAndChangesNoAnswer) {
  const test::Triangles t = test::shaken(test::sphere(3), .1), moved = test::shaken(test::sphere(3), .2);
  const std::vector<int> order = AabbTree(t.points, t.faces).order();
  const AabbTree own(moved.points, moved.faces), given(moved.points, moved.faces, order);
  EXPECT_EQ(given.order(), order);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(-2, 2);
  for (int i = 0; i < 300; ++i) {
    const Vec3 x(u(random), u(random), u(random));
    EXPECT_EQ(own.closest(x).squared_distance, given.closest(x).squared_distance);
    EXPECT_EQ(own.closest(x).face, given.closest(x).face);
  }
}

TEST(AabbTree, SegmentsAreTrianglesThatRepeatAVertex) {
  const test::Triangles t = test::triangles({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}}, {{0, 1, 1}, {1, 2, 2}});
  const AabbTree tree(t.points, t.faces);
  EXPECT_EQ(tree.closest({1, 3, 0}).point, Vec3(2, 2, 0));
  EXPECT_EQ(tree.closest({1, -1, 0}).point, Vec3(1, 0, 0));
}

TEST(AabbTree, EmptyTreeFindsNothing) {
  const AabbTree tree(Mat3X(3, 0), {});
  EXPECT_TRUE(tree.empty());
  EXPECT_EQ(tree.closest({0, 0, 0}).face, -1);
  EXPECT_EQ(tree.closest({0, 0, 0}).squared_distance, std::numeric_limits<double>::infinity());
  tree.for_each_overlapping_pair(0, tree.parts(), [](const auto&, const auto&) { FAIL(); });
}

struct Item {
  std::uint64_t key;
  int id;
};

/// Keys of up to so many bits, some of them alike.
std::vector<Item> random_items(size_t count, int bits) {
  std::mt19937_64 random(count);
  std::vector<Item> items;
  for (size_t i = 0; i < count; ++i)
    items.push_back({i % 3 == 0 && i > 0 ? items[i / 2].key : random() >> (64 - bits), static_cast<int>(i)});
  return items;
}

TEST(RadixSort, IsAStableSort) {
  for (size_t count : {0, 1, 2, 16, 17, 100, 5000, 100000})
    for (int bits : {1, 5, 40, 64}) {
      std::vector<Item> items = random_items(count, bits), expected = items, parallel = items;
      std::vector<Item> buffer(count);
      const auto key = [](const Item& item) { return item.key; };
      std::ranges::stable_sort(expected, {}, &Item::key);
      radix_sort<Item>(items, buffer, key);
      parallel_radix_sort<Item>(parallel, buffer, key);
      for (size_t i = 0; i < count; ++i) {
        ASSERT_EQ(items[i].id, expected[i].id);
        ASSERT_EQ(parallel[i].id, expected[i].id);
      }
    }
}

TEST(SpatialOrder, GoesFromNeighbourToNeighbourInAGrid) {
  constexpr int n = 16;
  std::vector<Vec3> grid;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) grid.emplace_back(i, j, k);
  const std::vector<int> order = spatial_order(grid);
  for (size_t i = 1; i < order.size(); ++i) ASSERT_EQ((grid[order[i]] - grid[order[i - 1]]).norm(), 1);
}

TEST(SpatialOrder, HasEveryIdOnceAndKeepsTheirOrderWherePointsCoincide) {
  EXPECT_TRUE(spatial_order({}).empty());
  EXPECT_EQ(spatial_order({Vec3::Ones(), Vec3::Ones(), Vec3::Ones()}), (std::vector<int>{0, 1, 2}));
  std::vector<Vec3> points;
  for (int i = 0; i < 1000; ++i) points.push_back(1e-40 * Vec3(i % 7, i % 11, i % 13));
  std::vector<int> order = spatial_order(points);
  std::ranges::sort(order);
  std::vector<int> ids(points.size());
  std::iota(ids.begin(), ids.end(), 0);
  EXPECT_EQ(order, ids);
}

}  // namespace hooke::aabb_tree_test
