#include "hooke/connectivity/lloyd_flow.h"

#include <gtest/gtest.h>

#include <cmath>

#include "hooke/constraints/constraints.h"
#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/extent.h"
#include "hooke/mesh/topology.h"
#include "hooke/working_mesh/working_mesh.h"
#include "support/working_scene.h"

namespace hooke::lloyd_flow_test {

LloydFlowResult flow_for(WorkingMesh& mesh, int rounds, const Observer& observer = nullptr) {
  return flow(mesh, rounds, {}, observer);
}

TEST(Flow, RegularisesAnUnevenSphere) {
  const test::Triangles t = test::sphere(3, .4, 3);
  test::WorkingScene s(t, test::unit_sphere());
  const double before = min_angle(t.points, t.faces);
  const LloydFlowResult result = flow_for(s.mesh, 60);
  EXPECT_EQ(result.rounds, 60);
  EXPECT_GT(result.flips, 0);
  EXPECT_LT(before, 15);
  EXPECT_GT(min_angle(s.positions.points, s.halfedges.faces()), 30);
  for (const Triangle& f : s.halfedges.faces())
    EXPECT_GE(face_alignment(s.positions.points, s.positions.normals, f), .3);
  EXPECT_LT((s.positions.points.colwise().norm().array() - 1).abs().maxCoeff(), 1e-9);
}

TEST(Flow, KeepsTheBoundary) {
  const test::Triangles t = test::grid(8, test::flat, .45, 8);
  test::WorkingScene s(t, test::plane());
  s.vertices.corner_valences = corner_valences(t.points, s.adjacency, s.constraints);
  flow_for(s.mesh, 30);
  const int n = static_cast<int>(t.points.cols());
  const std::vector<Edge> edges = test::boundary_edges(n, s.halfedges.faces());
  EXPECT_EQ(edges, test::boundary_edges(n, t.faces));
  for (const Edge& e : edges) {
    const Vec3 p = s.positions.points.col(e[0]);
    const double to_side = std::min({p[0], 1 - p[0], p[1], 1 - p[1]},
                                    [](double a, double b) { return std::abs(a) < std::abs(b); });
    EXPECT_NEAR(to_side, 0, 1e-12);
  }
  for (int corner : {0, 8, 72, 80})
    EXPECT_EQ(Vec3(s.positions.points.col(corner)), Vec3(t.points.col(corner)));
  EXPECT_NEAR(total_area(s.positions.points, s.halfedges.faces()), 1, 1e-12);
}

TEST(Flow, OneThreadAndTwoGiveTheSameBits) {
  const test::Triangles t = test::sphere(3, .4, 3);
  test::WorkingScene one(t, test::unit_sphere()), two(t, test::unit_sphere());
  {
    ThreadLimit limit(1);
    flow_for(one.mesh, 10);
  }
  {
    ThreadLimit limit(2);
    flow_for(two.mesh, 10);
  }
  EXPECT_EQ(one.positions.points, two.positions.points);
  EXPECT_EQ(one.halfedges.faces(), two.halfedges.faces());
}

TEST(Flow, StopsWhenTheObserverSaysSo) {
  test::WorkingScene s(test::sphere(2, .3, 1), test::unit_sphere());
  const LloydFlowResult result = flow_for(s.mesh, 60, [](const Progress& p) { return p.step < 4; });
  EXPECT_TRUE(result.interrupted);
  EXPECT_EQ(result.rounds, 4);
}

TEST(Flow, MovesNoVertexFartherThanItsCapInARound) {
  const test::Triangles t = test::sphere(3, .4, 3);
  test::WorkingScene s(t, test::unit_sphere());
  flow_for(s.mesh, 1);
  const double L = s.vertices.vertex_length[0];
  EXPECT_LE((s.positions.points - t.points).colwise().norm().maxCoeff(), .3 * L);
}

/// A lattice of equilateral triangles with edges of length 1.
test::Triangles lattice(int n) {
  test::Triangles t = test::grid(n, test::flat);
  for (Eigen::Index v = 0; v < t.points.cols(); ++v) {
    const Vec3 p = t.points.col(v) * n;
    t.points.col(v) = Vec3(p[0], 0, 0) + p[1] * Vec3(-.5, std::sqrt(.75), 0);
  }
  return t;
}

/// Centroid of the polygon of circumcentres about an inner vertex, by the shoelace formula.
Vec3 centroid_of_voronoi_cell(const test::WorkingScene& s, int v) {
  std::vector<Vec3> corners;
  for (int h : s.halfedges.outgoing(v)) {
    const Mat3X& X = s.positions.points;
    const Vec3 p = X.col(v), q = X.col(s.halfedges.to(h)), r = X.col(s.halfedges.opposite_vertex(h));
    Eigen::Matrix2d A;
    A << q[0] - p[0], q[1] - p[1], r[0] - p[0], r[1] - p[1];
    const Eigen::Vector2d b(.5 * (q.squaredNorm() - p.squaredNorm()),
                            .5 * (r.squaredNorm() - p.squaredNorm()));
    const Eigen::Vector2d c = A.inverse() * b;
    corners.push_back(Vec3(c[0], c[1], 0));
  }
  double area = 0;
  Vec3 sum = Vec3::Zero();
  for (size_t i = 0; i < corners.size(); ++i) {
    const Vec3 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const double cross = a[0] * b[1] - a[1] * b[0];
    area += cross / 2;
    sum += cross / 6 * (a + b);
  }
  return sum / area;
}

/// Is the vertex, and all about it, away from the boundary?
bool deep_inside(const test::WorkingScene& s, int v) {
  const std::vector<char> boundary = boundary_vertices(s.adjacency);
  for (int w : s.adjacency.vertex_neighbours[v])
    if (boundary[w]) return false;
  return !boundary[v];
}

TEST(Lloyd, ARegularLatticeStays) {
  const test::Triangles t = lattice(6);
  test::WorkingScene s(t, test::plane());
  const Mat3X step = lloyd_step(s.positions, s.adjacency, s.vertices.vertex_length);
  const std::vector<char> boundary = boundary_vertices(s.adjacency);
  for (int v = 0; v < t.points.cols(); ++v) EXPECT_TRUE(boundary[v] || step.col(v).norm() < 1e-12) << v;
}

TEST(Lloyd, AStepLeadsToTheCentroidOfTheVoronoiCell) {
  test::WorkingScene first(test::grid(8, test::flat, .3, 4), test::plane());
  flip_to_delaunay(first.mesh);
  test::WorkingScene s({first.positions.points, first.halfedges.faces()}, test::plane());
  const Mat3X step = lloyd_step(s.positions, s.adjacency, s.vertices.vertex_length) / lloyd_over_relaxation;
  int compared = 0;
  for (int v = 0; v < step.cols(); ++v) {
    if (!deep_inside(s, v)) continue;
    EXPECT_LT((s.positions.points.col(v) + step.col(v) - centroid_of_voronoi_cell(s, v)).norm(), 1e-9) << v;
    ++compared;
  }
  EXPECT_GT(compared, 20);
}

TEST(Lloyd, ATurnedMeshTakesTurnedSteps) {
  const test::Triangles t = test::sphere(2, .2, 9);
  test::WorkingScene s(t, test::unit_sphere());
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  test::WorkingScene turned({turn * t.points, t.faces}, test::unit_sphere());
  const Mat3X a = lloyd_step(s.positions, s.adjacency, s.vertices.vertex_length);
  const Mat3X b = lloyd_step(turned.positions, turned.adjacency, turned.vertices.vertex_length);
  EXPECT_LT((turn * a - b).norm(), 1e-10);
  EXPECT_GT(a.norm(), .01);
}

TEST(Lloyd, ABoundaryVertexHeadsForWhereItsEdgesHaveTheRatioOfTheirTargets) {
  test::Triangles t = test::grid(2, test::flat);
  t.points(0, 1) = .2;  // vertex 1 lies between 0 at x = 0 and 2 at x = 1
  test::WorkingScene s(t, test::plane());
  EXPECT_NEAR(
      lloyd_step(s.positions, s.adjacency, s.vertices.vertex_length)(0, 1) / lloyd_boundary_relaxation, .3,
      1e-12);
  s.vertices.vertex_length[1] = 1;
  s.vertices.vertex_length[0] = 2;
  s.vertices.vertex_length[2] = 5;  // 3 : 6
  EXPECT_NEAR(
      lloyd_step(s.positions, s.adjacency, s.vertices.vertex_length)(0, 1) / lloyd_boundary_relaxation,
      1. / 3 - .2, 1e-12);
}

TEST(Lloyd, VerticesCrowdWhereTheTargetsAreSmall) {
  test::WorkingScene s(lattice(6), test::plane());
  for (size_t v = 0; v < s.vertices.vertex_length.size(); ++v)
    s.vertices.vertex_length[v] = 1 + .1 * s.positions.points(0, static_cast<Eigen::Index>(v));
  const Mat3X step = lloyd_step(s.positions, s.adjacency, s.vertices.vertex_length);
  for (int v = 0; v < step.cols(); ++v) EXPECT_TRUE(!deep_inside(s, v) || step(0, v) < -1e-3) << v;
}

}  // namespace hooke::lloyd_flow_test
