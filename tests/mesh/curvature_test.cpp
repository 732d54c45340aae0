#include "hooke/mesh/curvature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hooke/mesh/wedges.h"
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

TEST(FittedCurvature, IsThatOfTheSurfaceHoweverBadTheTriangles) {
  test::Triangles t = test::sphere(3, .45, 2);
  t.points *= 5;
  const VertexCurvature fitted = fitted_curvature(t.points, test::connect(t)),
                        discrete = measure_curvature(t.points, test::connect(t));
  double error = 0, error_of_discrete = 0;
  for (size_t v = 0; v < fitted.mean.size(); ++v) {
    EXPECT_NEAR(fitted.gaussian[v], .04, .004);
    error = std::max(error, std::abs(fitted.mean[v] - .2));
    error_of_discrete = std::max(error_of_discrete, std::abs(discrete.mean[v] - .2));
  }
  EXPECT_LT(error, .01);
  EXPECT_GT(error_of_discrete, 2 * error);
}

TEST(FittedCurvature, HasTheSignOfASaddleAndNoValueOnTheBoundary) {
  const test::Triangles t = test::grid(8, [](double x, double y) { return (x - .5) * (y - .5); });
  const VertexCurvature k = fitted_curvature(t.points, test::connect(t));
  EXPECT_TRUE(std::isnan(k.mean[0]) && std::isnan(k.gaussian[4]));
  EXPECT_NEAR(k.gaussian[40], -1, 1e-9);  // the middle: principal curvatures 1 and -1
  EXPECT_NEAR(k.mean[40], 0, 1e-9);
}

TEST(PrincipalCurvature, OfACylinderIsThatOfItsCircle) {
  test::Triangles t = test::grid(24, test::flat, .4, 5);
  for (auto p : t.points.colwise()) p = Vec3(.5 * std::sin(2 * p[0]), p[1], .5 * std::cos(2 * p[0]));
  for (double k : curvatures(t)) EXPECT_NEAR(k, 2, .06);
}

TEST(PrincipalCurvature, OfAPlaneIsZero) {
  for (double k : curvatures(test::moved(test::grid(6, test::flat, .4)))) EXPECT_NEAR(k, 0, 1e-9);
}

/// A ring of 24 sides between the radii 1 and 2, flat or, between creases, beside another that stands on it.
test::Triangles ring(bool with_wall) {
  constexpr int sides = 24;
  test::Triangles t;
  t.points.resize(3, (with_wall ? 3 : 2) * sides);
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    const Vec3 x(std::cos(angle), std::sin(angle), 0);
    t.points.col(i) = x;
    t.points.col(sides + i) = 2 * x;
    if (with_wall) t.points.col(2 * sides + i) = 2 * x + Vec3::UnitZ();
    const int next = (i + 1) % sides;
    for (int k = 0; k < (with_wall ? 2 : 1); ++k) {
      t.faces.push_back({k * sides + i, (k + 1) * sides + i, k * sides + next});
      t.faces.push_back({k * sides + next, (k + 1) * sides + i, (k + 1) * sides + next});
    }
  }
  return t;
}

TEST(PrincipalCurvature, OfABoundaryIsThatOfItsCircle) {
  const std::vector<double> k = curvatures(ring(false));
  for (size_t v = 0; v < 24; ++v) EXPECT_NEAR(k[v], 1, 1e-9);
  for (size_t v = 24; v < 48; ++v) EXPECT_NEAR(k[v], .5, 1e-9);
}

TEST(PrincipalCurvature, OfACreaseIsThatOfItsCircleAndOfBothSides) {
  const test::Triangles t = ring(true);
  Adjacency c = test::connect(t);
  std::vector<Edge> rim;
  for (const Edge& e : c.edges)
    if (std::min(e[0], e[1]) >= 24 && std::max(e[0], e[1]) < 48) rim.push_back(e);
  ASSERT_EQ(rim.size(), 24u);
  const std::vector<double> without = largest_curvatures(t.points, c);
  split_wedges(c, rim);
  const std::vector<double> k = largest_curvatures(t.points, c);
  for (size_t v = 24; v < 48; ++v) {
    EXPECT_NEAR(k[v], .5, .1);
    EXPECT_GT(without[v], .7);  // the bend is taken for a round one
  }
}

TEST(PrincipalCurvature, OfARaggedBoundaryIsThatOfItsCourse) {
  test::Triangles t = test::grid(8, test::flat);
  for (int v = 0; v < 9; v += 2) t.points(1, v) -= .04;
  const std::vector<double> k = curvatures(t);
  for (size_t v = 2; v < 7; ++v) EXPECT_NEAR(k[v], 0, 1e-9);
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
