#include "hooke/integrator/final_projection.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "hooke/constraints/constraints.h"
#include "hooke/filter/retraction.h"
#include "hooke/geometry/self_intersection.h"
#include "support/scene.h"

namespace hooke {
namespace {

constexpr double height = .05;  // of the upper sheet; edges are .125 long

/// Two sheets close above each other. The lower has the lower ids.
struct Sheets {
  test::Triangles lower = test::grid(8, test::flat, .2, 3);
  test::Scene scene;
  Placement to = scene.placement;
  std::vector<int> inner;  // vertices that are not on a boundary

  Sheets()
      : scene(test::both(lower, raised(lower)),
              Surface([n = lower.points.cols()](const Vec3& x, int v, double) {
                return Foot{Vec3(x[0], x[1], v < n ? 0 : height), Vec3::UnitZ(), v, FootStatus::converged, 1};
              })) {
    for (int v = 0; v < scene.connectivity.vertex_count; ++v)
      if (scene.constraints.freedom[static_cast<size_t>(v)] == Freedom::surface) inner.push_back(v);
  }

  static test::Triangles raised(test::Triangles t) {
    t.points.row(2).array() += height;
    return t;
  }

  /// A vertex of the upper sheet goes through the lower one.
  int push_through(Placement& p) const {
    const int v = inner.back() - 20;
    p.points(2, v) -= 2 * height;
    return v;
  }

  std::vector<std::array<int, 2>> pairs(const Placement& p) const {
    return find_self_intersections(p.points, scene.connectivity.faces);
  }
  size_t crossings(const Placement& p) const { return pairs(p).size(); }
};

TEST(Landing, WhatCrossesGoesBackAndNothingFarFromIt) {
  Sheets s;
  const Placement& from = s.scene.placement;
  for (int v : s.inner) {
    s.to.points.col(v) += Vec3(.01, -.01, 0);
    s.to.anchors[static_cast<size_t>(v)] += 1;
  }
  const Placement moved = s.to;
  const int v = s.push_through(s.to);
  ASSERT_EQ(s.crossings(from), 0u);
  ASSERT_GT(s.crossings(s.to), 0u);

  const std::vector<int> back = put_back_crossings(s.scene.guards, s.scene.connectivity, from, s.to);
  EXPECT_EQ(s.crossings(s.to), 0u);
  EXPECT_NE(std::ranges::find(back, v), back.end());
  EXPECT_LT(back.size(), s.inner.size() / 2);
  for (int w : s.inner) {
    const bool is_back = std::ranges::find(back, w) != back.end();
    const Placement& expected = is_back ? from : moved;
    EXPECT_EQ(s.to.points.col(w), expected.points.col(w)) << w;
    EXPECT_EQ(s.to.anchors[static_cast<size_t>(w)], expected.anchors[static_cast<size_t>(w)]) << w;
  }
}

TEST(Landing, WhatCrossedBeforeMayGoOnToAndSlide) {
  Sheets s;
  const int through = s.push_through(s.scene.placement);
  s.to = s.scene.placement;
  s.to.points.col(s.inner[3]) += Vec3(.01, 0, 0);
  s.to.points.col(through) += Vec3(.04, .03, 0);
  const Placement moved = s.to;
  ASSERT_GT(s.crossings(s.to), 0u);
  ASSERT_NE(s.pairs(s.to), s.pairs(s.scene.placement));
  EXPECT_TRUE(put_back_crossings(s.scene.guards, s.scene.connectivity, s.scene.placement, s.to).empty());
  EXPECT_TRUE(test::same(s.to, moved));
}

TEST(Landing, WhereNothingCrossesNothingGoesBack) {
  Sheets s;
  for (int v : s.inner) s.to.points.col(v) += Vec3(.01, .01, 0);
  const Placement moved = s.to;
  EXPECT_TRUE(put_back_crossings(s.scene.guards, s.scene.connectivity, s.scene.placement, s.to).empty());
  EXPECT_TRUE(test::same(s.to, moved));
}

}  // namespace
}  // namespace hooke
