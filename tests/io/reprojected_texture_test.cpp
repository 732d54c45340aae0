#include "hooke/io/reprojected_texture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "hooke/geometry/triangle.h"
#include "hooke/io/polygon_triangulation.h"
#include "support/remeshed.h"

namespace hooke::reprojected_texture_test {
namespace {

// A strip of two quads, 1 by 2, with texture coordinates (s, t) = (x, y), and (x + 10, y) right of the seam
// at x = 1 if there is one. Its triangles are cut along the diagonals from the lower left.
struct Strip {
  IntLists polygons{{0, 4, 8}, {0, 1, 4, 3, 1, 2, 5, 4}};
  Mat3X points = (Mat3X(3, 6) << 0, 1, 2, 0, 1, 2, 0, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0).finished();
  Mat3X values = points;
  std::vector<int> elements = polygons.items;

  explicit Strip(bool seam = false) {
    if (!seam) return;
    values.conservativeResize(3, 10);
    values.rightCols(4) = points(Eigen::all, {1, 2, 5, 4});
    values.rightCols(4).row(0).array() += 10;
    for (int k = 0; k < 4; ++k) elements[4 + static_cast<size_t>(k)] = 6 + k;
  }

  /// The texture after vertex 1 went to (x, 0).
  ReprojectedTexture moved(double x) {
    Mat3X after = points;
    after(0, 1) = x;
    return reproject_texture({polygons, elements, values, points, after});
  }
};

TEST(ReprojectedTexture, FollowsTheVertex) {
  const ReprojectedTexture texture = Strip().moved(1.25);
  EXPECT_EQ(Vec3(texture.values.col(1)), Vec3(1.25, 0, 0));
  EXPECT_EQ(texture.moved, (std::vector<char>{0, 1, 0, 0, 0, 0}));
  EXPECT_EQ(texture.torn, 0);
}

TEST(ReprojectedTexture, EachSideOfASeamKeepsItsOwn) {
  const ReprojectedTexture texture = Strip(true).moved(1.25);
  EXPECT_EQ(Vec3(texture.values.col(6)), Vec3(11.25, 0, 0)) << "interpolated";
  EXPECT_EQ(Vec3(texture.values.col(1)), Vec3(1.25, 0, 0)) << "extrapolated";
}

TEST(ReprojectedTexture, WhereItWouldTurnOverItStays) {
  const ReprojectedTexture texture = Strip(true).moved(2.25);  // beyond vertex 2
  EXPECT_EQ(Vec3(texture.values.col(6)), Vec3(11, 0, 0));
  EXPECT_EQ(Vec3(texture.values.col(1)), Vec3(1, 0, 0)) << "farther than an edge";
}

TEST(ReprojectedTexture, EqualCoordinatesAreNoSeam) {
  Strip strip(true);
  strip.values.rightCols(4).row(0).array() -= 10;
  const ReprojectedTexture texture = strip.moved(1.25);
  EXPECT_EQ(Vec3(texture.values.col(1)), Vec3(1.25, 0, 0));
  EXPECT_EQ(Vec3(texture.values.col(6)), Vec3(1.25, 0, 0));
}

TEST(ReprojectedTexture, SharedByOtherVerticesItStaysAndIsCounted) {
  Strip strip;
  strip.elements[0] = 1;  // the corner at vertex 0
  const ReprojectedTexture texture = strip.moved(1.25);
  EXPECT_EQ(texture.torn, 1);
  EXPECT_EQ(texture.values, strip.values);
}

TEST(ReprojectedTexture, NothingMovesWithoutMotionOrWithoutTexture) {
  Strip strip(true);
  EXPECT_EQ(strip.moved(1).moved, std::vector<char>(10, 0));
  strip.elements.assign(8, -1);
  EXPECT_EQ(strip.moved(1.25).moved, std::vector<char>(10, 0));
}

// An open barrel of quads between uneven meridians and circles. Its one chart, (angle / full turn, z / 2), is
// cut along a meridian, on which its vertices are at uneven heights.
struct Barrel {
  static constexpr int around = 24, up = 16;
  IntLists polygons{{0}, {}};
  Mat3X points = Mat3X(3, around*(up + 1)), values = Mat3X(3, (around + 1) * (up + 1));
  std::vector<int> elements;

  Barrel() {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> shift(-.25, .25);
    for (int j = 0; j <= up; ++j)
      for (int i = 0; i <= around; ++i) {
        const double inner = j > 0 && j < up ? 1 : 0;
        const double u = i % around > 0 ? (i + inner * shift(random)) / around : (i == 0 ? 0 : 1);
        const double z = i < around ? 2 * (j + inner * shift(random)) / up : 2 * values(1, row(j, 0));
        values.col(row(j, i)) = Vec3(u, z / 2, 0);
        if (i < around) points.col(vertex(j, i)) = place(u, z);
      }
    for (int j = 0; j < up; ++j)
      for (int i = 0; i < around; ++i) {
        for (const auto& [k, l] : {std::pair{j, i}, {j, i + 1}, {j + 1, i + 1}, {j + 1, i}}) {
          polygons.items.push_back(vertex(k, l));
          elements.push_back(row(k, l));
        }
        polygons.first.push_back(static_cast<int>(polygons.items.size()));
      }
  }

  static int vertex(int j, int i) { return j * around + i % around; }
  static int row(int j, int i) { return j * (around + 1) + i; }
  static Vec3 place(double u, double z) {
    const double radius = .6 + .4 * std::sin(std::numbers::pi * z / 2), angle = 2 * std::numbers::pi * u;
    return {radius * std::cos(angle), radius * std::sin(angle), z};
  }
};

TEST(ReprojectedTexture, AChartThatBordersOnItselfIsNotTornAtItsSeam) {
  const Barrel barrel;
  const TriangulatedPolygons cut = triangulate(barrel.points, barrel.polygons);
  const Mat3X after = test::remeshed({barrel.points, cut.triangles}, RemeshOptions{}).points;
  double off_seam = 0;  // turns
  for (int j = 0; j <= Barrel::up; ++j) {
    const Vec3 x = after.col(Barrel::vertex(j, 0));
    off_seam = std::max(off_seam, std::abs(std::atan2(x[1], x[0])) / (2 * std::numbers::pi));
  }
  EXPECT_GT(off_seam, .01) << "vertices leave the seam";
  const ReprojectedTexture texture =
      reproject_texture({barrel.polygons, barrel.elements, barrel.values, barrel.points, after});
  EXPECT_EQ(texture.torn, 0);
  for (const Triangle& t : items_of_triangles(cut, barrel.polygons, barrel.elements)) {
    const auto extent = [&](const Mat3X& values) {
      const auto [least, greatest] = std::minmax({values(0, t[0]), values(0, t[1]), values(0, t[2])});
      return greatest - least;
    };
    EXPECT_LT(extent(texture.values), 2 * extent(barrel.values));
    EXPECT_GT(doubled_area_vector(texture.values, t)[2], 0);
  }
  for (std::size_t c = 0; c < barrel.elements.size(); ++c) {
    const Vec3 x = after.col(barrel.polygons.items[c]), uv = texture.values.col(barrel.elements[c]);
    const double turn = std::atan2(x[1], x[0]) / (2 * std::numbers::pi);
    EXPECT_NEAR(uv[0] - turn, std::round(uv[0] - turn), 5e-3);
    EXPECT_NEAR(uv[1], x[2] / 2, 5e-3);
  }
}

TEST(ReprojectedTexture, CornersAtAPoleStayInTheirFaces) {
  // A cone of eight faces with its own value of the tip in each; the tip moves into the first.
  constexpr int n = 8;
  IntLists polygons{{0}, {}};
  Mat3X points(3, n + 1), values(3, 2 * n + 1);
  std::vector<int> elements;
  points.col(n) = Vec3::Zero();
  for (int i = 0; i <= n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    if (i < n) points.col(i) = Vec3(std::cos(angle), std::sin(angle), 0);
    values.col(i) = Vec3(i, 0, 0);
    if (i == n) continue;
    values.col(n + 1 + i) = Vec3(i + .5, 1, 0);
    polygons.items.insert(polygons.items.end(), {i, (i + 1) % n, n});
    polygons.first.push_back(3 * (i + 1));
    elements.insert(elements.end(), {i, i + 1, n + 1 + i});
  }
  Mat3X after = points;
  after.col(n) = .1 * (points.col(0) + points.col(1));
  const ReprojectedTexture texture = reproject_texture({polygons, elements, values, points, after});
  for (int i = 0; i < n; ++i) EXPECT_NEAR(texture.values(0, n + 1 + i), i + .5, .5) << i;
  EXPECT_NEAR(texture.values(1, n + 1), .8, 1e-12);
}

}  // namespace
}  // namespace hooke::reprojected_texture_test
