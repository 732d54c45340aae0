#include "hooke/connectivity/adaptation.h"

#include <gtest/gtest.h>

#include "adapting_scene.h"
#include "solids.h"

namespace hooke {
namespace {

/// Limited by the surface only.
constexpr CoarseLimits any_number{.levels = 10, .least_faces = 0, .rim_share = 9, .irregular_share = -1};

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
  CoarseLimits limits = any_number;
  for (int levels : {0, 1}) {
    limits.levels = levels;
    EXPECT_EQ(levels_of(s, limits), levels);
  }
  const double faces = static_cast<double>(s.connectivity.faces.size());
  limits.levels = 3;
  limits.least_faces = .9 * faces / 4;
  EXPECT_EQ(levels_of(s, limits), 1);
  limits.least_faces = 1.1 * faces / 4;
  EXPECT_EQ(levels_of(s, limits), 0);
}

TEST(CoarseLevels, AMeshThatIsRegularAlreadyHasNone) {
  const test::AdaptingScene regular(test::sphere(4), test::unit_sphere());
  EXPECT_EQ(levels_of(regular, {}), 0);
  test::AdaptingScene too_fine(test::sphere(4), test::unit_sphere());
  for (double& length : too_fine.vertex_length) length *= 1.5;
  EXPECT_EQ(levels_of(too_fine, {}), 1);
  EXPECT_EQ(levels_of(test::AdaptingScene(test::sphere(4, .3, 3), test::unit_sphere()), {}), 1);
}

TEST(CoarseLevels, AreThoseOfTheSurfaceHoweverFinelyItIsMeshed) {
  // A large sphere of small faces beside a small one of large faces: the edges of the latter are 1 in 80, but
  // it takes a quarter of the target mesh.
  test::Triangles flat = test::sphere(5), bent = test::sphere(2);
  flat.points *= 2;
  bent.points.row(0).array() += 5;
  const test::Triangles t = test::both(flat, bent);
  const Surface both = [](const Vec3& x, int anchor, double) {
    const Vec3 centre(x[0] > 3 ? 5 : 0, 0, 0), n = (x - centre).normalized();
    return Foot{centre + (x[0] > 3 ? 1 : 2) * n, n, anchor, FootStatus::converged, 1};
  };
  test::AdaptingScene s(t, both);
  for (double& length : s.vertex_length) length = .3;
  CoarseLimits limits = any_number;
  const double round = .5 * std::tan(.3 / 4);  // sagitta of an edge of the small sphere over its length
  limits.sagitta = 1.5 * round;
  EXPECT_EQ(levels_of(s, limits), 0);  // the large sphere alone would bear one
  limits.bent_share = .5;
  EXPECT_EQ(levels_of(s, limits), 1);
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
  // At level 1 about 44 of 144 vertices are on the rim and its corners stand still, at level 2 22 of 36.
  for (const auto& [share, levels] : {std::pair(.25, 0), std::pair(.45, 1), std::pair(.8, 2)}) {
    limits.rim_share = share;
    EXPECT_EQ(levels_of(s, limits), levels) << share;
  }
}

TEST(CoarseLevels, VerticesThatStandStillDoNotGetFewer) {
  test::AdaptingScene s(test::sphere(4, .2, 3), test::unit_sphere());
  CoarseLimits limits = any_number;
  limits.rim_share = .25;
  EXPECT_GE(levels_of(s, limits), 2);
  for (size_t v = 0; v < s.constraints.freedom.size(); v += 25) s.constraints.freedom[v] = Freedom::fixed;
  EXPECT_EQ(levels_of(s, limits), 1);  // .04 of the vertices: .16 at level 1, .64 at level 2
}

}  // namespace
}  // namespace hooke
