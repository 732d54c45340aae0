#include "hooke/connectivity/lloyd_flow.h"

#include <gtest/gtest.h>

#include "flipping_scene.h"
#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"

namespace hooke {
namespace {

FlowResult flow_for(FlippingMesh& mesh, int rounds, const Observer& observer = nullptr) {
  return flow(mesh, {.rounds = rounds}, {}, {}, observer);
}

TEST(Flow, RegularisesAnUnevenSphere) {
  const test::Triangles t = test::sphere(3, .4, 3);
  test::FlippingScene s(t, test::unit_sphere());
  const double before = least_angle(t.points, t.faces);
  const FlowResult result = flow_for(s.mesh, 60);
  EXPECT_EQ(result.rounds, 60);
  EXPECT_GT(result.flips, 0);
  EXPECT_LT(before, 15);
  EXPECT_GT(least_angle(s.placement.points, s.triangulation.faces()), 30);
  for (const Triangle& f : s.triangulation.faces())
    EXPECT_GE(face_alignment(s.placement.points, s.placement.normals, f), .3);
  EXPECT_LT((s.placement.points.colwise().norm().array() - 1).abs().maxCoeff(), 1e-9);
}

TEST(Flow, KeepsTheBoundary) {
  const test::Triangles t = test::grid(8, test::flat, .45, 8);
  test::FlippingScene s(t, test::plane());
  s.corner_valences = corner_valences(t.points, s.connectivity, s.constraints, 35);
  flow_for(s.mesh, 30);
  const int n = static_cast<int>(t.points.cols());
  const std::vector<Edge> edges = test::boundary_edges(n, s.triangulation.faces());
  EXPECT_EQ(edges, test::boundary_edges(n, t.faces));
  for (const Edge& e : edges) {
    const Vec3 p = s.placement.points.col(e[0]);
    const double to_side = std::min({p[0], 1 - p[0], p[1], 1 - p[1]},
                                    [](double a, double b) { return std::abs(a) < std::abs(b); });
    EXPECT_NEAR(to_side, 0, 1e-12);
  }
  for (int corner : {0, 8, 72, 80})
    EXPECT_EQ(Vec3(s.placement.points.col(corner)), Vec3(t.points.col(corner)));
  EXPECT_NEAR(total_area(s.placement.points, s.triangulation.faces()), 1, 1e-12);
}

TEST(Flow, OneThreadAndTwoGiveTheSameBits) {
  const test::Triangles t = test::sphere(3, .4, 3);
  test::FlippingScene one(t, test::unit_sphere()), two(t, test::unit_sphere());
  {
    ThreadLimit limit(1);
    flow_for(one.mesh, 10);
  }
  {
    ThreadLimit limit(2);
    flow_for(two.mesh, 10);
  }
  EXPECT_EQ(one.placement.points, two.placement.points);
  EXPECT_EQ(one.triangulation.faces(), two.triangulation.faces());
}

TEST(Flow, StopsWhenTheObserverSaysSo) {
  test::FlippingScene s(test::sphere(2, .3, 1), test::unit_sphere());
  const FlowResult result = flow_for(s.mesh, 60, [](const Progress& p) { return p.step < 4; });
  EXPECT_TRUE(result.interrupted);
  EXPECT_EQ(result.rounds, 4);
}

TEST(Flow, MovesNoVertexFartherThanItsCapInARound) {
  const test::Triangles t = test::sphere(3, .4, 3);
  test::FlippingScene s(t, test::unit_sphere());
  flow_for(s.mesh, 1);
  const double L = s.vertex_length[0];
  EXPECT_LE((s.placement.points - t.points).colwise().norm().maxCoeff(), .3 * L);
}

}  // namespace
}  // namespace hooke
