#include "hooke/coarse_levels.h"

#include <gtest/gtest.h>

#include "adapting_scene.h"

namespace hooke {
namespace {

constexpr CoarseLimits any_number{.levels = 10, .least_faces = 0, .rim_share = 9};

int levels_of(const test::AdaptingScene& s, const CoarseLimits& limits = any_number) {
  return coarse_levels(s.adapting, static_cast<double>(s.connectivity.faces.size()), limits);
}

TEST(CoarseLevels, GrowByOneWhereTheMeshIsTwiceAsFine) {
  const test::AdaptingScene coarse(test::sphere(3, .2, 3), test::unit_sphere());
  const test::AdaptingScene fine(test::sphere(4, .2, 3), test::unit_sphere());
  EXPECT_GE(levels_of(coarse), 1);
  EXPECT_EQ(levels_of(fine), levels_of(coarse) + 1);
}

TEST(CoarseLevels, AreThoseThatTheSagittaAllows) {
  const test::AdaptingScene s(test::sphere(4, 0, 3), test::unit_sphere());
  for (double sagitta : {.02, .05, .1}) {
    CoarseLimits limits = any_number;
    limits.sagitta = sagitta;
    const auto on_unit_circle = [&](int level) {
      return std::tan(std::ldexp(s.vertex_length[0], level) / 4) / 2;
    };
    const int levels = levels_of(s, limits);
    EXPECT_LE(on_unit_circle(levels), 1.1 * sagitta);  // edges are a little longer than arcs turn
    EXPECT_GT(on_unit_circle(levels + 1), .9 * sagitta);
  }
}

TEST(CoarseLevels, AreLimited) {
  const test::AdaptingScene s(test::sphere(4, .2, 3), test::unit_sphere());
  EXPECT_EQ(levels_of(s, {.levels = 1}), 1);
  EXPECT_EQ(levels_of(s, {.levels = 0}), 0);
  const double faces = static_cast<double>(s.connectivity.faces.size());
  EXPECT_EQ(levels_of(s, {.levels = 3, .least_faces = .9 * faces / 4}), 1);
  EXPECT_EQ(levels_of(s, {.levels = 3, .least_faces = 1.1 * faces / 4}), 0);
}

TEST(CoarseLevels, ThereAreNoneBetweenCreases) {
  constexpr int cells = 12;
  std::vector<Edge> crease;
  for (int v = cells / 2 * (cells + 1); crease.size() < cells; ++v) crease.push_back({v, v + 1});
  const test::Triangles t = test::grid(cells, test::flat, .1);
  EXPECT_GT(levels_of(test::AdaptingScene(t, test::plane())), 0);
  EXPECT_EQ(levels_of(test::AdaptingScene(t, test::plane(), crease)), 0);
}

TEST(CoarseLevels, ARimTakesNoMoreThanItsShare) {
  const test::AdaptingScene s(test::grid(24, test::flat, .1), test::plane());
  CoarseLimits limits = any_number;
  limits.rim_share = .4;  // 96 of 625 vertices: 48 of 144 at level 1, 24 of 36 at level 2
  EXPECT_EQ(levels_of(s, limits), 1);
  limits.rim_share = .7;
  EXPECT_EQ(levels_of(s, limits), 2);
}

}  // namespace
}  // namespace hooke
