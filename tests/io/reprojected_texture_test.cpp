#include "hooke/io/reprojected_texture.h"

#include <gtest/gtest.h>

namespace hooke::reprojected_texture_test {

// A strip of two quads, 1 by 2, with texture coordinates (s, t) = (x, y), and (x + 10, y) right of the seam
// at x = 1 if there is one. Its triangles are cut along the diagonals from the lower left.
struct Strip {
  IntLists polygons{{0, 4, 8}, {0, 1, 4, 3, 1, 2, 5, 4}};
  Mat3X points = (Mat3X(3, 6) << 0, 1, 2, 0, 1, 2, 0, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0).finished();
  Mat3X values = points;
  std::vector<int> elements = polygons.items;
  std::vector<MapEntry> map;

  explicit Strip(bool seam = false) {
    for (int v = 0; v < 6; ++v) map.push_back({v, {}});
    if (!seam) return;
    values.conservativeResize(3, 10);
    values.rightCols(4) = points(Eigen::all, {1, 2, 5, 4});
    values.rightCols(4).row(0).array() += 10;
    for (int k = 0; k < 4; ++k) elements[static_cast<size_t>(4 + k)] = 6 + k;
  }

  /// The texture after vertex 1 went to (x, 0), which is in that triangle with those weights.
  ReprojectedTexture moved(double x, int face, const Vec3& weights) {
    Mat3X after = points;
    after(0, 1) = x;
    map[1].position = {face, weights};
    return reproject_texture({polygons, elements, values, points, after, map});
  }
};

TEST(ReprojectedTexture, FollowsTheVertex) {
  const ReprojectedTexture texture = Strip().moved(1.25, 2, {.75, .25, 0});
  EXPECT_EQ(Vec3(texture.values.col(1)), Vec3(1.25, 0, 0));
  EXPECT_EQ(texture.moved, (std::vector<char>{0, 1, 0, 0, 0, 0}));
  EXPECT_EQ(texture.torn, 0);
}

TEST(ReprojectedTexture, EachSideOfASeamKeepsItsOwn) {
  const ReprojectedTexture texture = Strip(true).moved(1.25, 2, {.75, .25, 0});
  EXPECT_EQ(Vec3(texture.values.col(6)), Vec3(11.25, 0, 0)) << "interpolated";
  EXPECT_EQ(Vec3(texture.values.col(1)), Vec3(1.25, 0, 0)) << "extrapolated";
}

TEST(ReprojectedTexture, EqualCoordinatesAreNoSeam) {
  Strip strip(true);
  strip.values.rightCols(4).row(0).array() -= 10;
  const ReprojectedTexture texture = strip.moved(1.25, 2, {.75, .25, 0});
  EXPECT_EQ(Vec3(texture.values.col(1)), Vec3(1.25, 0, 0));
  EXPECT_EQ(Vec3(texture.values.col(6)), Vec3(1.25, 0, 0));
}

TEST(ReprojectedTexture, SharedByOtherVerticesItStaysAndIsCounted) {
  Strip strip;
  strip.elements[0] = 1;  // the corner at vertex 0
  const ReprojectedTexture texture = strip.moved(1.25, 2, {.75, .25, 0});
  EXPECT_EQ(texture.torn, 1);
  EXPECT_EQ(texture.values, strip.values);
}

TEST(ReprojectedTexture, NothingMovesWithoutMotionOrWithoutTexture) {
  Strip strip(true);
  EXPECT_EQ(strip.moved(1, -1, Vec3::Zero()).moved, std::vector<char>(10, 0));
  strip.elements.assign(8, -1);
  EXPECT_EQ(strip.moved(1.25, 2, {.75, .25, 0}).moved, std::vector<char>(10, 0));
}

}  // namespace hooke::reprojected_texture_test
