#include "hooke/mesh/image_surfaces.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

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

TEST(Isosurface, MayHaveManyCells) {
  const test::Triangles ball = test::marched_cubes(9, outside_of_ball);
  test::Triangles far = ball;
  far.points.colwise() += Vec3(500, 0, 0);
  test::Triangles t = test::both(ball, far);
  t.points = (.7131 * t.points * 1000).array().round() / 1000;  // few digits, so that no face is just as wide
  EXPECT_TRUE(is_isosurface_at(.7, t));
}

TEST(Isosurface, IsWholeButForAFewFacesAndVerticesInNone) {
  const test::Triangles body = test::marched_cubes(10, [](const Vec3& x) { return x.norm() - 9.4; });
  test::Triangles few = test::cube(), many = test::sphere(1);
  few.points.colwise() += Vec3(30, .3, .3);
  many.points.colwise() += Vec3(30, .3, .3);
  ASSERT_LT(few.faces.size(), .01 * static_cast<double>(body.faces.size()));
  EXPECT_TRUE(is_isosurface_at(1, test::both(body, few)));
  EXPECT_FALSE(is_isosurface_at(1, test::both(body, many)));
  test::Triangles loose = body;
  const Eigen::Index count = body.points.cols();
  loose.points.conservativeResize(3, 2 * count);
  loose.points.rightCols(count) = body.points.colwise() + Vec3(.3, .4, .2);
  EXPECT_TRUE(is_isosurface_at(1, loose));
}

TEST(Isosurface, IsNoMeshOfBlocksAndNoOtherMesh) {
  // Planes of the grid: all vertices are at its points.
  test::Triangles blocks =
      test::marched_cubes(9, [](const Vec3& x) { return x.cwiseAbs().maxCoeff() - 5.5; });
  EXPECT_TRUE(is_isosurface_at(1, blocks));
  blocks.points = blocks.points.array().round();
  EXPECT_FALSE(is_isosurface_at(1, blocks));
  EXPECT_FALSE(is_isosurface_at(1, test::sphere(3)));
  EXPECT_FALSE(is_isosurface_at(1, test::marched_cubes(3, [](const Vec3& x) { return x.norm() - 1.4; })))
      << "a crumb";
}

TEST(Isosurface, IsNoHeightField) {
  test::Triangles t = test::grid(20, test::flat);
  t.points *= 20;
  for (Eigen::Index v = 0; v < t.points.cols(); ++v)  // all in one layer of cells, some across it
    t.points(2, v) = v % 3 == 0 ? 0 : v % 3 == 1 ? 1 : static_cast<double>(v % 89) / 89;
  EXPECT_FALSE(is_isosurface_at(1, t));
}

TEST(Isosurface, HasFewFacesInACell) {
  // A box with all vertices on its edges, of which each side is a fan: one cell with all faces.
  constexpr int on_edge = 20;
  test::Triangles t;
  std::vector<Vec3> points;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const double side : {0., 1.}) {
      const auto first = static_cast<int>(points.size());
      for (int k = 0; k < 4 * on_edge; ++k) {
        const double at = static_cast<double>(k % on_edge) / on_edge;
        const std::array<std::array<double, 2>, 4> around = {{{at, 0}, {1, at}, {1 - at, 1}, {0, 1 - at}}};
        Vec3 x;
        x[static_cast<Eigen::Index>(axis)] = side;
        x[static_cast<Eigen::Index>((axis + 1) % 3)] = around[static_cast<std::size_t>(k / on_edge)][0];
        x[static_cast<Eigen::Index>((axis + 2) % 3)] = around[static_cast<std::size_t>(k / on_edge)][1];
        points.push_back(x);
        if (k >= 2) t.faces.push_back({first, first + k - 1, first + k});
      }
    }
  t.points.resize(3, std::ssize(points));
  for (Eigen::Index v = 0; v < t.points.cols(); ++v) t.points.col(v) = points[static_cast<std::size_t>(v)];
  EXPECT_FALSE(is_isosurface_at(1, t));
}

}  // namespace hooke::isosurface_test
