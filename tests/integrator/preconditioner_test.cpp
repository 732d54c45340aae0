#include "hooke/integrator/preconditioner.h"

#include <gtest/gtest.h>

#include "hooke/core/parallel.h"
#include "support/scene.h"

namespace hooke::preconditioner_test {

/// A wavy sheet, 31 cells of the finest grid wide.
Mat3X sheet() {
  const auto color = [](double x, double y) { return .1 * std::sin(9 * x) * std::cos(7 * y); };
  return test::grid(60, color, .3).points;
}
constexpr double cell = 1. / 31;

Mat3X applied(const GridHierarchy& grids, const Mat3X& x) {
  Mat3X y = Mat3X::Zero(3, x.cols());
  grids.add(grids.solve(x), 1, y);
  return y;
}

double dot(const Mat3X& a, const Mat3X& b) {
  return a.cwiseProduct(b).sum();
}

TEST(GridHierarchy, IsSymmetricAndPositive) {
  const Mat3X points = sheet();
  const GridHierarchy grids(points, cell);
  ASSERT_GE(grids.level_count(), 3);
  for (unsigned seed : {1u, 2u, 3u}) {
    const Mat3X x = test::random_vectors(points.cols(), 1, seed);
    const Mat3X y = test::random_vectors(points.cols(), 1, seed + 10);
    const Mat3X px = applied(grids, x);
    EXPECT_NEAR(dot(y, px), dot(x, applied(grids, y)), 1e-10 * px.norm() * y.norm());
    EXPECT_GT(dot(x, px), 0);
  }
}

TEST(GridHierarchy, TurnsWithTheMesh) {
  const Mat3X points = sheet();
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(.7, Vec3(3, 1, -2).normalized()).toRotationMatrix();
  Mat3X turned = turn * points;
  turned.colwise() += Vec3(5, -3, 1);
  const Mat3X x = test::random_vectors(points.cols(), 1);
  const Mat3X y = applied(GridHierarchy(points, cell), x);
  EXPECT_LT((applied(GridHierarchy(turned, cell), turn * x) - turn * y).norm(), 1e-9 * y.norm());
}

TEST(GridHierarchy, TurnsWithAMeshAmongManyVerticesInOnePlace) {
  const Mat3X mesh = sheet();
  Mat3X points(3, 100000 + mesh.cols());  // comparing all pairs of these would take minutes
  points.colwise() = Vec3(.5, .5, 1);
  points.leftCols(mesh.cols()) = mesh;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(.7, Vec3(3, 1, -2).normalized()).toRotationMatrix();
  Mat3X x = Mat3X::Zero(3, points.cols());
  x.leftCols(mesh.cols()) = test::random_vectors(mesh.cols(), 1);
  const Mat3X y = applied(GridHierarchy(points, cell), x);
  EXPECT_LT((applied(GridHierarchy(turn * points, cell), turn * x) - turn * y).norm(), 1e-9 * y.norm());
}

TEST(GridHierarchy, ScalesWithItsCells) {
  const Mat3X points = sheet();
  const Mat3X x = test::random_vectors(points.cols(), 1);
  EXPECT_EQ(applied(GridHierarchy(points, cell), x), applied(GridHierarchy(8 * points, 8 * cell), x));
}

TEST(GridHierarchy, AddsInProportionToTheWeight) {
  const Mat3X points = sheet();
  const GridHierarchy grids(points, cell);
  const Mat3X x = test::random_vectors(points.cols(), 1);
  Mat3X y = x;
  grids.add(grids.solve(x), .25, y);
  EXPECT_LT((y - x - .25 * applied(grids, x)).norm(), 1e-12 * y.norm());
}

TEST(GridHierarchy, MovesAlikeWhatLiesInOnePlace) {
  Mat3X points = sheet();
  points.col(1000) = points.col(17);
  const Mat3X y = applied(GridHierarchy(points, cell), test::random_vectors(points.cols(), 1));
  EXPECT_EQ(y.col(1000), y.col(17));
}

TEST(GridHierarchy, PassesLongWavesAndDampsShortOnes) {
  const Mat3X points = sheet();
  const GridHierarchy grids(points, cell);
  const auto gain = [&](double colors) {
    Mat3X x = Mat3X::Zero(3, points.cols());
    x.row(0) = (2 * std::numbers::pi * colors * points.row(1)).array().sin();
    return dot(x, applied(grids, x)) / dot(x, x);
  };
  EXPECT_GT(gain(1), 5 * gain(8));
  EXPECT_GT(gain(8), 5 * gain(29));
}

TEST(GridHierarchy, OneThreadAndTwoGiveTheSameBits) {
  const Mat3X points = test::grid(120, test::flat, .3).points;  // more than one block of vertices
  const GridHierarchy grids(points, cell);
  const Mat3X x = test::random_vectors(points.cols(), 1);
  std::vector<Mat3X> y;
  for (int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    y.push_back(applied(grids, x));
  }
  EXPECT_EQ(y[0], y[1]);
}

TEST(GridHierarchy, FewPointsInALineOrNoneAreWelcome) {
  for (Eigen::Index count : {0, 1, 2, 5}) {
    Mat3X points = Mat3X::Zero(3, count);
    for (Eigen::Index v = 0; v < count; ++v) points(1, v) = static_cast<double>(v);
    const Mat3X y = applied(GridHierarchy(points, .5), Mat3X::Ones(3, count));
    EXPECT_EQ(y.cols(), count);
    EXPECT_TRUE(y.allFinite());
    if (count > 0) {
      EXPECT_GT(y.minCoeff(), 0);
    }
  }
}

}  // namespace hooke::preconditioner_test
