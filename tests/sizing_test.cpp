#include "hooke/sizing.h"

#include <gtest/gtest.h>

#include "hooke/error.h"
#include "solids.h"

namespace hooke {
namespace {

double natural_length_of(const test::Triangles& t) {
  return natural_length(total_area(t.points, t.faces), t.faces.size());
}

TEST(Sizing, AreasAreThoseOfGeometry) {
  const test::Triangles cube = test::cube();
  EXPECT_NEAR(total_area(cube.points, cube.faces), 6, 1e-14);
  const test::Triangles grid = test::grid(7, test::flat, .3);
  EXPECT_NEAR(total_area(grid.points, grid.faces), 1, 1e-13);
  const test::Triangles turned = test::moved(cube, 3);
  EXPECT_NEAR(total_area(turned.points, turned.faces), 54, 1e-12);
}

TEST(Sizing, EquilateralTrianglesHaveTheirEdgeAsNaturalLength) {
  EXPECT_NEAR(natural_length_of(test::equilateral()), 1, 1e-15);
  EXPECT_NEAR(natural_length_of(test::tetrahedron()), std::sqrt(8), 1e-14);
}

TEST(Sizing, AnEdgeIsTheMeanOfItsEndsAndAFaceOfItsEdges) {
  const Connectivity c = make_connectivity(3, {{0, 1, 2}});
  const TargetLengths targets = spread_target_lengths(c, {1, 2, 6});
  const std::vector<double> expected = {1.5, 4, 3.5};
  EXPECT_EQ(targets.edge, expected);
  EXPECT_DOUBLE_EQ(targets.face[0], 3);
}

TEST(Sizing, TargetsOfAFaceAlwaysFormATriangle) {
  const Connectivity c = test::connect(test::sphere(2));
  std::mt19937 random(4);
  std::uniform_real_distribution<double> exponent(-6, 6);
  std::vector<double> length(static_cast<size_t>(c.vertex_count));
  for (double& l : length) l = std::pow(10, exponent(random));
  const TargetLengths targets = spread_target_lengths(c, length);
  for (const auto& edges : c.face_edges)
    for (size_t k = 0; k < 3; ++k) {
      const auto side = [&](size_t i) { return targets.edge[static_cast<size_t>(edges[(k + i) % 3])]; };
      EXPECT_LE(side(0), (side(1) + side(2)) * (1 + 1e-15));
    }
}

TEST(LengthSpec, MeansWhatItSays) {
  const test::Triangles cube = test::cube();
  const Connectivity c = test::connect(cube);
  const auto length = [&](const char* text) { return resolve_length(parse_length(text), cube.points, c); };
  EXPECT_DOUBLE_EQ(length("auto"), natural_length(6, 12));
  EXPECT_DOUBLE_EQ(length("2x"), 2 * natural_length(6, 12));
  EXPECT_DOUBLE_EQ(length("10%"), .1 * std::sqrt(3));
  EXPECT_DOUBLE_EQ(length("1.5e-1"), .15);
  EXPECT_DOUBLE_EQ(length("mean"), (12 + 6 * std::sqrt(2)) / 18);
}

TEST(LengthSpec, RefusesWhatIsNoLength) {
  for (const char* text :
       {"", "%", "x", "0", "-1", "nan", "inf", "1e999", "2 x", "2xx", "2%x", "two", "Auto"})
    EXPECT_THROW(parse_length(text), Error) << text;
}

}  // namespace
}  // namespace hooke
