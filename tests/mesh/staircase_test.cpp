#include "hooke/mesh/image_surfaces.h"

#include <gtest/gtest.h>

#include <array>
#include <map>

#include "hooke/mesh/extent.h"
#include "support/masks.h"
#include "support/solids.h"

namespace hooke::staircase_test {

/// The surface of the cells of a grid, of edge 1, whose centres lie inside.
template <typename IsInside>
test::Triangles surface_of_mask(int size, const IsInside& is_inside) {
  std::map<std::array<int, 3>, int> ids;
  std::vector<Triangle> faces;
  const auto vertex = [&](const std::array<int, 3>& at) {
    return ids.try_emplace(at, static_cast<int>(ids.size())).first->second;
  };
  const auto inside = [&](const std::array<int, 3>& cell) {
    return is_inside(Vec3(cell[0] + .5, cell[1] + .5, cell[2] + .5));
  };
  for (int x = -size; x < size; ++x)
    for (int y = -size; y < size; ++y)
      for (int z = -size; z < size; ++z)
        for (size_t axis = 0; axis < 3; ++axis)
          for (int side : {-1, 1}) {
            const std::array<int, 3> cell = {x, y, z};
            std::array<int, 3> other = cell;
            other[axis] += side;
            if (!inside(cell) || inside(other)) continue;
            std::array<int, 4> quad;
            for (size_t k = 0; k < 4; ++k) {
              std::array<int, 3> corner = cell;
              corner[axis] += side > 0;
              corner[(axis + 1) % 3] += k == 1 || k == 2;
              corner[(axis + 2) % 3] += k >= 2;
              quad[side > 0 ? k : 3 - k] = vertex(corner);
            }
            faces.push_back({quad[0], quad[1], quad[2]});
            faces.push_back({quad[0], quad[2], quad[3]});
          }
  test::Triangles t;
  t.points.resize(3, std::ssize(ids));
  for (const auto& [at, v] : ids) t.points.col(v) = Vec3(at[0], at[1], at[2]);
  t.faces = faces;
  return t;
}

bool is_staircase_at(double length, const test::Triangles& t) {
  return is_staircase(t.points, test::connect(t), std::vector<double>(t.points.cols(), length));
}

test::Triangles mask_of_ball() {
  return surface_of_mask(9, [](const Vec3& x) { return x.norm() < 8; });
}

TEST(Staircase, IsTheSurfaceOfAMaskWhoseStepsAreNotResolved) {
  EXPECT_TRUE(is_staircase_at(2, mask_of_ball()));
  EXPECT_FALSE(is_staircase_at(1, mask_of_ball()));
}

TEST(Staircase, MayBeTurnedAndStretched) {
  test::Triangles t = mask_of_ball();
  t.points.row(2) *= 1.4;
  EXPECT_TRUE(is_staircase_at(2, test::moved(t)));
}

TEST(Staircase, IsNoBoxAndNoScan) {
  const test::Triangles box = surface_of_mask(9, [](const Vec3& x) { return x.cwiseAbs().maxCoeff() < 8; });
  EXPECT_FALSE(is_staircase_at(3, box));
  EXPECT_FALSE(is_staircase_at(3, test::shaken(mask_of_ball(), .05)));
  EXPECT_FALSE(is_staircase_at(10, test::sphere(3)));
}

test::Triangles marched_ball() {
  return test::marched_mask(10, [](const Vec3& x) { return (x - Vec3(.3, .2, .1)).norm() < 8; });
}

TEST(MarchedStaircase, IsTheSurfaceOfAMaskOfAnySlices) {
  test::Triangles t = marched_ball();
  EXPECT_TRUE(is_staircase_at(1, t));
  EXPECT_TRUE(is_staircase_at(1, test::moved(t)));
  t.points.row(2) *= 2.5;
  EXPECT_TRUE(is_staircase_at(1, test::moved(t)));
  EXPECT_FALSE(is_staircase_at(.1, t)) << "the length resolves the steps";
}

TEST(MarchedStaircase, IsNoScanAndNoBox) {
  EXPECT_FALSE(is_staircase_at(1, test::shaken(marched_ball(), .05)));
  EXPECT_FALSE(
      is_staircase_at(1, test::marched_mask(9, [](const Vec3& x) { return x.cwiseAbs().maxCoeff() < 8; })));
}

/// The bodies of both, as one mesh.
test::Triangles together(test::Triangles a, const test::Triangles& b) {
  const auto n = static_cast<int>(a.points.cols());
  a.points.conservativeResize(3, n + b.points.cols());
  a.points.rightCols(b.points.cols()) = b.points;
  for (const Triangle& f : b.faces) a.faces.push_back({f[0] + n, f[1] + n, f[2] + n});
  return a;
}

TEST(MarchedStaircase, IsNoFileWithAnotherBody) {
  test::Triangles box = test::cube();
  box.points.array() *= 30;
  EXPECT_FALSE(is_staircase_at(1, together(marched_ball(), box)));
}

TEST(MarchedStaircase, IsNoHeightField) {
  const test::Triangles hills = test::grid(
      30, [](double x, double y) { return std::round(4 * std::sin(7 * x) * std::cos(5 * y)) / 30; });
  EXPECT_FALSE(is_staircase_at(1. / 30, hills));
}

TEST(MarchedStaircase, BodiesThatWouldShrinkStayAsTheyAre) {
  const test::Triangles speck = test::marched_mask(3, [](const Vec3& x) { return x.norm() < 1; });
  const Adjacency c = test::connect(speck);
  EXPECT_EQ(without_steps(speck.points, c, std::vector<char>(c.vertex_count, 0)), speck.points);
}

TEST(MarchedStaircase, LosesItsStepsButKeepsItsVolumeAndWhatIsHeld) {
  const test::Triangles t = marched_ball();
  const Adjacency c = test::connect(t);
  std::vector<char> is_held(c.vertex_count, 0);
  is_held[0] = 1;
  const Mat3X smooth = without_steps(t.points, c, is_held);
  EXPECT_EQ(smooth.col(0), t.points.col(0));
  EXPECT_LT((smooth - t.points).colwise().norm().maxCoeff(), .5);
  EXPECT_LT(measure_extent(smooth, c).area, .95 * measure_extent(t.points, c).area);
  EXPECT_NEAR(measure_extent(smooth, c).volume.value(), measure_extent(t.points, c).volume.value(),
              .003 * measure_extent(t.points, c).volume.value());
}

}  // namespace hooke::staircase_test
