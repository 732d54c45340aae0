#include "hooke/mesh/curvature.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/solids.h"

namespace hooke::curvature_test {

std::vector<double> curvatures(const test::Triangles& t) {
  return largest_curvatures(t.points, test::connect(t));
}

TEST(PrincipalCurvature, OfASphereIsThatOfItsRadiusHoweverBadTheTriangles) {
  for (double jitter : {0., .45}) {
    test::Triangles t = test::sphere(3, jitter, 2);
    t.points *= 5;
    for (double k : curvatures(t)) EXPECT_NEAR(k, .2, .01);
  }
}

TEST(PrincipalCurvature, OfACylinderIsThatOfItsCircle) {
  test::Triangles t = test::grid(24, test::flat, .4, 5);
  for (auto p : t.points.colwise()) p = Vec3(.5 * std::sin(2 * p[0]), p[1], .5 * std::cos(2 * p[0]));
  for (double k : curvatures(t)) EXPECT_NEAR(k, 2, .06);
}

TEST(PrincipalCurvature, OfAPlaneIsZero) {
  for (double k : curvatures(test::moved(test::grid(6, test::flat, .4)))) EXPECT_NEAR(k, 0, 1e-9);
}

TEST(PrincipalCurvature, IsOneOverTheLength) {
  const test::Triangles t = test::grid(8, test::paraboloid, .3);
  const std::vector<double> k = curvatures(t), half = curvatures({2 * t.points, t.faces});
  const std::vector<double> turned = curvatures(test::moved(t));
  for (size_t v = 0; v < k.size(); ++v) {
    EXPECT_EQ(half[v], k[v] / 2);
    EXPECT_NEAR(turned[v], k[v], 1e-9);
  }
}

TEST(PrincipalCurvature, IsDefinedOnTheSmallestMeshesAndWithoutFaces) {
  for (double k : curvatures(test::tetrahedron())) EXPECT_TRUE(std::isfinite(k));
  for (double k : curvatures(test::equilateral())) EXPECT_NEAR(k, 0, 1e-12);
  const Mat3X one = Mat3X::Zero(3, 4);
  EXPECT_EQ(largest_curvatures(one, make_adjacency(4, {}))[3], 0);
}

}  // namespace hooke::curvature_test
