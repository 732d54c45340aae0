#include "hooke/integrator/untangle.h"

#include <gtest/gtest.h>

#include "hooke/constraints/constraints.h"
#include "hooke/filter/retraction.h"
#include "hooke/geometry/triangle.h"
#include "hooke/integrator/relaxation.h"
#include "support/scene.h"

namespace hooke::untangle_test {

/// A flat grid whose vertex 40 is pulled over the edges that face it.
test::Triangles folded_grid() {
  test::Triangles t = test::grid(8, test::flat, .1);
  t.points.col(40) += Vec3(1.4, .3, 0) / 8;
  return t;
}

int downward_faces(const test::Scene& s) {
  int count = 0;
  for (const Triangle& t : s.adjacency.faces) count += test::area_vector(s.positions.points, t)[2] <= 0;
  return count;
}

TEST(Untangle, UnfoldsAVertexThatWasPulledAcrossAnEdge) {
  test::Scene s(folded_grid(), test::to_ground);
  ASSERT_GT(downward_faces(s), 0);
  Relaxation r = s.relaxation();
  const int before = downward_faces(s);
  const UntangleResult result = untangle(r, nullptr);
  EXPECT_EQ(result.folded_before, before);
  EXPECT_TRUE(result.folded.empty());
  EXPECT_EQ(downward_faces(s), 0);
  EXPECT_GT(result.sweeps, 0);
  EXPECT_FALSE(result.interrupted);
}

TEST(Untangle, UnfoldsOnASphere) {
  test::Triangles t = test::sphere(2);
  const int neighbour = test::connect(t).vertex_neighbours[60][0];
  t.points.col(60) = (2.2 * t.points.col(neighbour) - 1.2 * t.points.col(60)).normalized();
  test::Scene s(t, test::to_unit_sphere);
  ASSERT_FALSE(s.guards.folded_faces(s.positions).empty());
  Relaxation r = s.relaxation();
  EXPECT_TRUE(untangle(r, nullptr).folded.empty());
  for (const Triangle& face : t.faces)
    EXPECT_GT(test::area_vector(s.positions.points, face).dot(s.positions.points.col(face[0])), 0);
}

TEST(Untangle, OpensASliverThatHardlyLiesOutsideTheBoundary) {
  test::Triangles t = test::grid(8, test::flat, .1);
  t.points.col(13) = Vec3(t.points(0, 13), -.002, 0);  // next to the boundary
  test::Scene s(t, test::to_ground);
  ASSERT_GT(downward_faces(s), 0);
  Relaxation r = s.relaxation();
  EXPECT_TRUE(untangle(r, nullptr).folded.empty());
  EXPECT_GT(min_angle(s.positions.points, t.faces), 2);
}

TEST(Untangle, AMeshWithoutFoldsIsLeftAlone) {
  test::Scene s = test::ground_scene(.3);
  const SurfacePositions before = s.positions;
  Relaxation r = s.relaxation();
  const UntangleResult result = untangle(r, nullptr);
  EXPECT_EQ(result.folded_before, 0);
  EXPECT_EQ(result.sweeps, 0);
  EXPECT_TRUE(test::same(s.positions, before));
}

TEST(Untangle, PutsTheEnergyBackAsItWas) {
  test::Scene s(folded_grid(), test::to_ground);
  Relaxation r = s.relaxation();
  r.terms.altitude = .7;
  untangle(r, nullptr);
  EXPECT_EQ(r.terms.altitude, .7);
  EXPECT_EQ(r.terms.unfold, 0);
}

TEST(Untangle, StopsWhenAskedTo) {
  test::Scene s(folded_grid(), test::to_ground);
  Relaxation r = s.relaxation();
  int calls = 0;
  const UntangleResult result = untangle(r, [&](const Progress&) { return ++calls < 1; });
  EXPECT_TRUE(result.interrupted);
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(r.terms.unfold, 0);
}

TEST(Untangle, NamesWhatItCannotUnfold) {
  test::SceneOptions options;
  options.constraints.boundary = BoundaryRule::fixed;
  test::Triangles t = test::grid(2, test::flat);  // one inner vertex: the fold at the boundary stays
  t.points.col(1) += Vec3(.8, 0, 0);
  test::Scene s(t, test::to_ground, options);
  const int before = downward_faces(s);
  ASSERT_GT(before, 0);
  Relaxation r = s.relaxation();
  const UntangleResult result = untangle(r, nullptr);
  EXPECT_FALSE(result.folded.empty());
  EXPECT_LE(static_cast<int>(result.folded.size()), result.folded_before);
  for (int f : result.folded) EXPECT_LT(test::area_vector(s.positions.points, t.faces[f])[2], 1e-2);
}

}  // namespace hooke::untangle_test
