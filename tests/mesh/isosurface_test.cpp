#include "hooke/mesh/isosurface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/masks.h"
#include "support/solids.h"

namespace hooke::isosurface_test {

/// The distance of a box with a corner at the grid and sides that are not on it.
double outside_of_box(const Vec3& x) {
  return (x.cwiseAbs() - Vec3(6.3, 5.6, 4.2)).maxCoeff();
}

double outside_of_ball(const Vec3& x) {
  return (x - Vec3(.3, .2, .1)).norm() - 6.4;
}

bool is_isosurface_at(double length, const test::Triangles& t) {
  return is_isosurface(t.points, test::connect(t), std::vector<double>(t.points.cols(), length));
}

TEST(MarchedCubes, AreClosedAndHaveTheVolumeOfTheBody) {
  const test::Triangles box = test::marched_cubes(9, outside_of_box);
  const Adjacency c = test::connect(box);
  for (std::size_t e = 0; e < c.edges.size(); ++e) EXPECT_FALSE(c.is_boundary_edge(static_cast<int>(e)));
  double six_volumes = 0;
  for (const Triangle& t : box.faces)
    six_volumes += box.points.col(t[0]).dot(box.points.col(t[1]).cross(box.points.col(t[2])));
  EXPECT_NEAR(six_volumes / 6, 8 * 6.3 * 5.6 * 4.2, .02 * 8 * 6.3 * 5.6 * 4.2);
}

TEST(Isosurface, IsWhatMarchingCubesMakeOfAnImage) {
  EXPECT_TRUE(is_isosurface_at(1, test::marched_cubes(9, outside_of_ball)));
  EXPECT_TRUE(is_isosurface_at(1, test::marched_cubes(9, outside_of_box)));
}

TEST(Isosurface, MayHaveCellsOfAnyShapeAnywhereWithFewDigits) {
  test::Triangles t = test::marched_cubes(9, outside_of_ball);
  t.points.array().colwise() *= Eigen::Array3d(.7, .7, 2.5);
  t.points.colwise() += Vec3(-113.7, 42.1, 260.9);
  EXPECT_TRUE(is_isosurface_at(1, t));
  t.points = (t.points * 1000).array().round() / 1000;
  EXPECT_TRUE(is_isosurface_at(1, t));
}

TEST(Isosurface, MayBeOpen) {
  EXPECT_TRUE(is_isosurface_at(1, test::marched_cubes(5, outside_of_ball)));
}

TEST(Isosurface, HasCellsThatAreNotShorterThanTheLength) {
  const test::Triangles box = test::marched_cubes(9, outside_of_box);
  EXPECT_TRUE(is_isosurface_at(.2, box));
  EXPECT_FALSE(is_isosurface_at(2, box));
}

TEST(Isosurface, IsNeitherASmoothedNorATurnedOne) {
  const test::Triangles ball = test::marched_cubes(9, outside_of_ball);
  EXPECT_FALSE(is_isosurface_at(1, test::shaken(ball, .05)));
  EXPECT_FALSE(is_isosurface_at(1, test::moved(ball)));
}

TEST(Isosurface, IsNoMeshOfBlocksAndNoOtherMesh) {
  // Planes of the grid: all vertices are at its points.
  test::Triangles blocks =
      test::marched_cubes(9, [](const Vec3& x) { return x.cwiseAbs().maxCoeff() - 5.5; });
  blocks.points = (blocks.points * 2).array().round() / 2;
  EXPECT_TRUE(is_isosurface_at(1, blocks));
  blocks.points = blocks.points.array().round();
  EXPECT_FALSE(is_isosurface_at(1, blocks));
  EXPECT_FALSE(is_isosurface_at(1, test::sphere(3)));
}

TEST(Isosurface, IsNoHeightField) {
  test::Triangles t = test::marched_cubes(9, [](const Vec3& x) { return x[2] - .3 - .4 * std::sin(x[0]); });
  EXPECT_FALSE(is_isosurface_at(1, t));
}

TEST(Isosurface, HasManyCells) {
  // All vertices are on the edges of one box.
  test::Triangles t = test::marched_cubes(9, outside_of_ball);
  t.points.setZero();
  for (Eigen::Index v = 0; v < t.points.cols(); ++v)
    t.points(v % 3, v) = .001 + .998 * static_cast<double>(v) / static_cast<double>(t.points.cols());
  EXPECT_FALSE(is_isosurface_at(1, t));
}

}  // namespace hooke::isosurface_test
