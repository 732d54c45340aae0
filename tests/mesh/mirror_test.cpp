#include "hooke/mesh/mirror.h"

#include <gtest/gtest.h>

#include "support/meshes.h"
#include "support/solids.h"

namespace hooke::mirror_test {

template <typename Faces>
std::vector<int> axes_of(const Mat3X& points, const Faces& faces) {
  std::vector<int> axes;
  for (const Mirror& mirror : find_mirrors(points, faces)) axes.push_back(mirror.axis);
  return axes;
}

TEST(Mirror, OfASphereIsAcrossAllAxesAndMapsEachVertexToItsImage) {
  test::Triangles sphere = test::sphere(2);
  sphere.points.colwise() += Vec3(1, -2, 3);
  const std::vector<Mirror> mirrors = find_mirrors(sphere.points, sphere.faces);
  ASSERT_EQ(mirrors.size(), 3u);
  for (const Mirror& mirror : mirrors)
    for (int v = 0; v < sphere.points.cols(); ++v)
      EXPECT_LT((mirror(sphere.points.col(v)) - sphere.points.col(mirror.image[v])).norm(), 1e-9);
}

TEST(Mirror, MapsPolygonsToo) {
  const test::Triangles grid = test::grid(3, test::flat);  // with diagonals of one direction
  EXPECT_TRUE(axes_of(grid.points, grid.faces).empty());
  IntLists quads{{0}, {}};
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x) {
      for (const int v : {4 * y + x, 4 * y + x + 1, 4 * y + x + 5, 4 * y + x + 4}) quads.items.push_back(v);
      quads.first.push_back(static_cast<int>(quads.items.size()));
    }
  EXPECT_EQ(axes_of(grid.points, quads), (std::vector<int>{0, 1}));
}

TEST(Mirror, IsNoneOfWhatIsNotSymmetric) {
  const test::Triangles rough = test::sphere(2, .2);
  EXPECT_TRUE(axes_of(rough.points, rough.faces).empty());
  test::Triangles sphere = test::sphere(2);  // with the same middle
  sphere.points.col(20) += Vec3(.01, .01, .01);
  sphere.points.col(33) -= Vec3(.01, .01, .01);
  EXPECT_EQ(axes_of(sphere.points, sphere.faces).size(), 0u);
  const test::Triangles twice = test::both(test::sphere(1), test::sphere(1));
  EXPECT_TRUE(axes_of(twice.points, twice.faces).empty()) << "vertices share their places";
}

}  // namespace hooke::mirror_test
