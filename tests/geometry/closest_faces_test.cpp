#include "hooke/geometry/closest_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "support/crease_solids.h"
#include "support/solids.h"

namespace hooke::closest_faces_test {

/// Some points within `spread` of a point that is up to `reach` away from the origin.
std::vector<Vec3> cluster(std::mt19937& random, size_t count, double reach, double spread) {
  std::uniform_real_distribution<double> u(-1, 1);
  const auto vector = [&] { return Vec3(u(random), u(random), u(random)); };
  const Vec3 centre = reach * vector();
  std::vector<Vec3> points(count);
  std::ranges::generate(points, [&] { return Vec3(centre + spread * vector()); });
  return points;
}

/// Squared distance by testing all faces.
double min_of_all(const AabbTree& tree, const Vec3& x) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [corners, vertices, id] : tree.faces())
    least = std::min(least, closest_point(x, corners[0], corners[1], corners[2]).squared_distance);
  return least;
}

void expect_nearest_of_all(const AabbTree& tree, const std::vector<Vec3>& points, NearestFaceSearch& find) {
  std::vector<NearestFace> found(points.size());
  find(points, found);
  for (size_t i = 0; i < points.size(); ++i) {
    ASSERT_NEAR(found[i].squared_distance, min_of_all(tree, points[i]), 1e-30);
    const auto& [a, b, c] = tree.faces()[found[i].index].corners;
    ASSERT_EQ(found[i].squared_distance, closest_point(points[i], a, b, c).squared_distance);
  }
}

TEST(NearestFaces, AreThoseOfAllFacesToTheLastBit) {
  std::mt19937 random(7);
  for (double shake : {0., .1, .5}) {  // the last one has slivers and folds
    const test::Triangles t = test::shaken(test::sphere(3), shake);
    const AabbTree tree(t.points, t.faces);
    NearestFaceSearch find(tree);
    for (double spread : {0., .01, .1, 1.})
      for (size_t count : {1, 4, 5, 11, 170})
        expect_nearest_of_all(tree, cluster(random, count, 1.2, spread), find);
  }
}

TEST(NearestFaces, AreFoundFarAwayAndOnTheFacesThemselves) {
  std::mt19937 random(8);
  const test::Triangles t = test::shaken(test::sphere(2), .1);
  const AabbTree tree(t.points, t.faces);
  NearestFaceSearch find(tree);
  expect_nearest_of_all(tree, cluster(random, 50, 100, .1), find);
  for (const AabbTree::Face& face : tree.faces().first(20))
    expect_nearest_of_all(tree, {face.corners.begin(), face.corners.end()}, find);
}

TEST(NearestFaces, AreFoundAmongNeedlesWhoseBoxesOverlap) {
  std::mt19937 random(10);
  const test::Triangles t = test::moved(test::pyramid(400, 1, .5));
  const AabbTree tree(t.points, t.faces);
  ASSERT_FALSE(tree.slabs().empty());
  NearestFaceSearch find(tree);
  for (double spread : {.01, 1.})
    for (size_t count : {1, 11, 170}) expect_nearest_of_all(tree, cluster(random, count, 1.2, spread), find);
  for (const AabbTree::Face& face : tree.faces().first(50))
    expect_nearest_of_all(tree, {face.corners.begin(), face.corners.end()}, find);
}

TEST(NearestFaces, TakeFacesWithoutAreaAsTheirEdges) {
  std::mt19937 random(9);
  const test::Triangles t = test::triangles({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 0, 0}, {3, 3, 3}},
                                            {{0, 1, 3}, {1, 2, 2}, {4, 4, 4}});
  const AabbTree tree(t.points, t.faces);
  NearestFaceSearch find(tree);
  for (int i = 0; i < 20; ++i) expect_nearest_of_all(tree, cluster(random, 9, 3, .5), find);
}

TEST(NearestFaces, AreNoneInAnEmptyTree) {
  const AabbTree tree(Mat3X(3, 0), {});
  NearestFaceSearch find(tree);
  std::vector<NearestFace> found(7);
  find(std::vector<Vec3>(7, Vec3::Ones()), found);
  for (const NearestFace& f : found) {
    EXPECT_EQ(f.index, -1);
    EXPECT_EQ(f.squared_distance, std::numeric_limits<double>::infinity());
  }
}

}  // namespace hooke::closest_faces_test
