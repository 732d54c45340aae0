#include "hooke/io/polygon_triangulation.h"

#include <gtest/gtest.h>

#include "support/errors.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace hooke::polygon_triangulation_test {

struct Polygon {
  Mat3X points;
  IntLists corners;
};

Polygon polygon(const std::vector<Vec3>& points) {
  Polygon p{Mat3X(3, static_cast<Eigen::Index>(points.size())), {{0, static_cast<int>(points.size())}, {}}};
  for (size_t k = 0; k < points.size(); ++k) {
    p.points.col(static_cast<Eigen::Index>(k)) = points[k];
    p.corners.items.push_back(static_cast<int>(k));
  }
  return p;
}

Vec3 area_vector(const Mat3X& x, const Triangle& t) {
  const Vec3 a = x.col(t[0]), b = x.col(t[1]), c = x.col(t[2]);
  return .5 * (b - a).cross(c - a);
}

// The laws of a clean cut of a flat polygon: n - 2 triangles, none flipped or without area, areas sum to the
// polygon's.
void expect_clean_cut(const Polygon& p) {
  const TriangulatedPolygons cut = triangulate(p.points, p.corners);
  const auto n = p.corners.items.size();
  ASSERT_EQ(cut.triangles.size(), n - 2);
  EXPECT_EQ(cut.not_simple, 0);
  Vec3 whole = Vec3::Zero();
  for (Eigen::Index k = 0; k < p.points.cols(); ++k)
    whole += .5 * Vec3(p.points.col(k)).cross(Vec3(p.points.col((k + 1) % p.points.cols())));
  double sum = 0;
  for (const Triangle& t : cut.triangles) {
    EXPECT_GT(area_vector(p.points, t).dot(whole), 0);
    sum += area_vector(p.points, t).norm();
  }
  EXPECT_NEAR(sum, whole.norm(), 1e-12 * (whole.norm() + p.points.cwiseAbs().maxCoeff()));
}

// Also from every first corner, and in a general position and another scale.
void expect_clean_cuts(std::vector<Vec3> points) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  for (size_t k = 0; k < points.size(); ++k) {
    std::rotate(points.begin(), points.begin() + 1, points.end());
    expect_clean_cut(polygon(points));
    std::vector<Vec3> moved = points;
    for (Vec3& x : moved) x = 1e-6 * (turn * x);
    expect_clean_cut(polygon(moved));
  }
}

TEST(Polygons, ConvexConcaveAndCollinearCornersAreCutCleanly) {
  expect_clean_cuts({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  expect_clean_cuts({{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {.5, 1, 0}});                       // dart
  expect_clean_cuts({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}});  // L
  expect_clean_cuts({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 2, 0}});                        // straight corner
  expect_clean_cuts({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {3, 1, 0}, {3, 2, 0}, {3, 3, 0}});
  expect_clean_cuts({{0, 0, 0},
                     {6, 0, 0},
                     {6, 4, 0},
                     {1, 4, 0},
                     {1, 3, 0},
                     {5, 3, 0},
                     {5, 1, 0},
                     {2, 1, 0},
                     {2, 2, 0},
                     {0, 2, 0}});  // spiral
}

TEST(Polygons, StarsAndCombsAreCutCleanly) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> radius(.1, 1);
  for (int n : {5, 12, 60, 300}) {
    std::vector<Vec3> star;
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * std::numbers::pi * k / n, r = radius(random);
      star.emplace_back(r * std::cos(angle), r * std::sin(angle), 0);
    }
    expect_clean_cut(polygon(star));
  }
  std::vector<Vec3> comb;
  for (int k = 0; k < 100; ++k) comb.emplace_back(k, 0, 0);
  for (int k = 99; k >= 0; --k) comb.emplace_back(k, k % 2 == 0 ? 1 : 20, 0);
  expect_clean_cut(polygon(comb));
}

TEST(Polygons, AQuadrilateralIsCutAlongTheBetterDiagonal) {
  const Polygon kite = polygon({{-5, 0, 0}, {0, -1, 0}, {5, 0, 0}, {0, 1, 0}});
  EXPECT_EQ(triangulate(kite.points, kite.corners).triangles, (std::vector<Triangle>{{0, 1, 3}, {1, 2, 3}}));
  const Polygon thin = polygon({{0, 0, 0}, {1, 0, 0}, {1.5, 1e-4, 0}, {.5, 1e-4, 0}});
  EXPECT_EQ(triangulate(thin.points, thin.corners).triangles, (std::vector<Triangle>{{0, 1, 3}, {1, 2, 3}}));
}

TEST(Polygons, RoundingDoesNotCutQuadrilateralsOfAGridInDifferentWays) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int k = 0; k < 200; ++k) {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(3 * number(random), Vec3(number(random), 1, number(random)).normalized())
            .toRotationMatrix();
    std::vector<Vec3> corners{{0, 0, .1}, {2, 0, -.1}, {2, 1, .1}, {0, 1, -.1}};  // twisted
    const Vec3 offset(number(random), number(random), 0);
    for (Vec3& x : corners) {
      x = turn * x + offset;
      for (double& coordinate : x) coordinate = std::round(1e6 * coordinate) / 1e6;
    }
    const Polygon p = polygon(corners);
    EXPECT_EQ(triangulate(p.points, p.corners).triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  }
}

TEST(Polygons, TrianglesStayAsTheyAreAndKnowTheirPolygon) {
  Mat3X x(3, 5);
  x << 0, 1, 1, 0, .5,  //
      0, 0, 1, 1, 2,    //
      0, 0, 0, 0, 0;
  const IntLists faces{{0, 3, 7, 10}, {2, 1, 0, 0, 1, 2, 3, 4, 3, 2}};
  const TriangulatedPolygons cut = triangulate(x, faces);
  EXPECT_EQ(cut.polygon, (std::vector{0, 1, 1, 2}));
  EXPECT_EQ(cut.triangles.front(), (Triangle{2, 1, 0}));
  EXPECT_EQ(cut.triangles.back(), (Triangle{4, 3, 2}));
  EXPECT_EQ(cut.polygons_cut, 1);
  ContentWarnings content;
  Warnings others;
  append_warnings({}, "m", content, others);
  EXPECT_TRUE(content.anew.empty() && content.preserved.empty());
  append_warnings(cut, "m", content, others);
  EXPECT_TRUE(others.empty());
  for (const auto& [warnings, what] :
       {std::pair{content.anew, "cut into triangles: 1"}, {content.preserved, "written as they were: 1"}}) {
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0].code, "polygons_triangulated");
    EXPECT_TRUE(test::has(warnings[0].message, what)) << warnings[0].message;
  }
}

TEST(Polygons, WithoutACleanCutTheCountStaysRightAndItIsSaid) {
  for (const auto& points :
       {std::vector<Vec3>{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}},             // crossing
        std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}},  // a line
        std::vector<Vec3>(7, Vec3(1, 2, 3))}) {                                    // a point
    const Polygon p = polygon(points);
    const TriangulatedPolygons cut = triangulate(p.points, p.corners);
    EXPECT_EQ(cut.triangles.size(), points.size() - 2);
    EXPECT_EQ(cut.not_simple, 1);
    ContentWarnings content;
    Warnings others;
    append_warnings(cut, "m", content, others);
    ASSERT_EQ(others.size(), 1u);
    EXPECT_EQ(others[0].code, "polygons_not_simple");
  }
}

TEST(Polygons, ConcaveOnesAreCounted) {
  const auto count = [](const std::vector<Vec3>& points) {
    const Polygon p = polygon(points);
    return count_concave(p.points, p.corners);
  };
  EXPECT_EQ(count({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}), 0u);
  EXPECT_EQ(count({{0, 0, 0}, {1, 0, 0}, {1, 1, .3}, {0, 1, 0}}), 0u);
  EXPECT_EQ(count({{0, 0, 0}, {1, 0, 0}, {.5, .5, 0}, {0, 1, 0}}), 0u);  // straight
  EXPECT_EQ(count({{0, 0, 0}, {1, 0, 0}, {.4, .4, 0}, {0, 1, 0}}), 1u);
  EXPECT_EQ(count({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), 0u);
}

TEST(Polygons, FansThatOverlapAreMisread) {
  const auto misread = [](const std::vector<Vec3>& points) {
    const Polygon p = polygon(points);
    return misread_as_fans(p.points, p.corners, triangulate(p.points, p.corners));
  };
  const std::vector<Vec3> dart{{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {.5, 1, 0}};
  EXPECT_TRUE(misread(dart));
  EXPECT_FALSE(misread({dart[1], dart[2], dart[3], dart[0]})) << "from there the fan fits";
  EXPECT_FALSE(misread({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
}

}  // namespace hooke::polygon_triangulation_test
