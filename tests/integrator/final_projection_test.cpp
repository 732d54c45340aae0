#include "hooke/integrator/final_projection.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "hooke/constraints/constraints.h"
#include "hooke/filter/retraction.h"
#include "hooke/geometry/self_intersection.h"
#include "support/scene.h"

namespace hooke::final_projection_test {

constexpr double height = .05;  // of the upper sheet; edges are .125 long

/// Two sheets close above each other. The lower has the lower ids.
struct Sheets {
  test::Triangles lower = test::grid(8, test::flat, .2, 3);
  test::Scene scene;
  SurfacePositions to = scene.positions;
  std::vector<int> inner;  // vertices that are not on a boundary

  Sheets()
      : scene(test::both(lower, raised(lower)),
              Surface([n = lower.points.cols()](const Vec3& x, int v, double) {
                return Projection{Vec3(x[0], x[1], v < n ? 0 : height), Vec3::UnitZ(), v,
                                  ProjectionStatus::converged, 1};
              })) {
    for (int v = 0; v < scene.adjacency.vertex_count; ++v)
      if (scene.constraints.freedom[v] == Freedom::surface) inner.push_back(v);
  }

  static test::Triangles raised(test::Triangles t) {
    t.points.row(2).array() += height;
    return t;
  }

  /// Moves a vertex of the upper sheet through the lower one.
  int push_through(SurfacePositions& p) const {
    const int v = inner.back() - 20;
    p.points(2, v) -= 2 * height;
    return v;
  }

  std::vector<std::array<int, 2>> pairs(const SurfacePositions& p) const {
    return find_self_intersections(p.points, scene.adjacency.faces);
  }
  size_t crossings(const SurfacePositions& p) const { return pairs(p).size(); }
};

TEST(FinalProjection, WhatCrossesGoesBackAndNothingFarFromIt) {
  Sheets s;
  const SurfacePositions& from = s.scene.positions;
  for (int v : s.inner) {
    s.to.points.col(v) += Vec3(.01, -.01, 0);
    s.to.hints[v] += 1;
  }
  const SurfacePositions moved = s.to;
  const int v = s.push_through(s.to);
  ASSERT_EQ(s.crossings(from), 0u);
  ASSERT_GT(s.crossings(s.to), 0u);

  const std::vector<int> back =
      revert_crossings(s.scene.guards, s.scene.adjacency, s.scene.constraints, from, s.to);
  EXPECT_EQ(s.crossings(s.to), 0u);
  EXPECT_NE(std::ranges::find(back, v), back.end());
  EXPECT_LT(back.size(), s.inner.size() / 2);
  for (int w : s.inner) {
    const bool is_back = std::ranges::find(back, w) != back.end();
    const SurfacePositions& expected = is_back ? from : moved;
    EXPECT_EQ(s.to.points.col(w), expected.points.col(w)) << w;
    EXPECT_EQ(s.to.hints[w], expected.hints[w]) << w;
  }
}

TEST(FinalProjection, WhatCrossedBeforeMayGoOnToAndSlide) {
  Sheets s;
  const int through = s.push_through(s.scene.positions);
  s.to = s.scene.positions;
  s.to.points.col(s.inner[3]) += Vec3(.01, 0, 0);
  s.to.points.col(through) += Vec3(.04, .03, 0);
  const SurfacePositions moved = s.to;
  ASSERT_GT(s.crossings(s.to), 0u);
  ASSERT_NE(s.pairs(s.to), s.pairs(s.scene.positions));
  EXPECT_TRUE(
      revert_crossings(s.scene.guards, s.scene.adjacency, s.scene.constraints, s.scene.positions, s.to)
          .empty());
  EXPECT_TRUE(test::same(s.to, moved));
}

TEST(FinalProjection, WhereNothingCrossesNothingGoesBack) {
  Sheets s;
  for (int v : s.inner) s.to.points.col(v) += Vec3(.01, .01, 0);
  const SurfacePositions moved = s.to;
  EXPECT_TRUE(
      revert_crossings(s.scene.guards, s.scene.adjacency, s.scene.constraints, s.scene.positions, s.to)
          .empty());
  EXPECT_TRUE(test::same(s.to, moved));
}

}  // namespace hooke::final_projection_test
