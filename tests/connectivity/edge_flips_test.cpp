#include "hooke/connectivity/edge_flips.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hooke/constraints/constraints.h"
#include "hooke/geometry/local_shape.h"
#include "hooke/mesh/halfedge_mesh.h"
#include "support/working_scene.h"

namespace hooke::edge_flips_test {

double worst_opposite_angles(const HalfedgeMesh& t, const Mat3X& points) {
  double worst = 0;
  for (int h = 0; h < t.half_edge_count(); ++h)
    if (t.twin(h) >= 0) worst = std::max(worst, opposite_angles(t, points, h));
  return worst;
}

/// The square (0,1) x (0,1) of two triangles; the far corner (vertex 2) has a given position. The diagonal is
/// 0-2.
test::Triangles quad(const Vec3& corner) {
  test::Triangles t;
  t.points.resize(3, 4);
  t.points.col(0) = Vec3(0, 0, 0);
  t.points.col(1) = Vec3(1, 0, 0);
  t.points.col(2) = corner;
  t.points.col(3) = Vec3(0, 1, 0);
  t.faces = {{0, 1, 2}, {0, 2, 3}};
  return t;
}

/// Four faces about the inner vertex 4 of a square.
test::Triangles fan_in_square(const Vec3& inner) {
  test::Triangles t = quad(Vec3(1, 1, 0));
  t.points.conservativeResize(3, 5);
  t.points.col(4) = inner;
  t.faces = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  return t;
}

TEST(EdgeFlips, APlaneMeshBecomesDelaunay) {
  test::Triangles t = test::grid(8, test::flat, .45, 5);
  for (Eigen::Index v = 0; v < t.points.cols(); ++v) t.points(0, v) *= 3;  // stretched: many flips to do
  test::WorkingScene s(t, test::plane());
  ASSERT_GT(worst_opposite_angles(s.halfedges, t.points), std::numbers::pi + .1);
  EXPECT_GT(flip_to_delaunay(s.mesh), 0);
  EXPECT_LE(worst_opposite_angles(s.halfedges, t.points), std::numbers::pi + 1e-9);
  EXPECT_EQ(flip_to_delaunay(s.mesh), 0);
}

TEST(EdgeFlips, BoundaryEdgesStay) {
  const test::Triangles t = test::grid(8, test::paraboloid, .45, 6);
  test::WorkingScene s(t, test::plane());
  ASSERT_GT(flip_to_delaunay(s.mesh), 0);
  const int n = static_cast<int>(t.points.cols());
  EXPECT_EQ(test::boundary_edges(n, s.halfedges.faces()), test::boundary_edges(n, t.faces));
  for (int h = 0; h < s.halfedges.half_edge_count(); ++h)
    EXPECT_FALSE(s.halfedges.twin(h) < 0 && may_flip(s.mesh, h));
}

TEST(EdgeFlips, NoFaceFoldsAndNoVertexLosesItsThirdEdgeOnASphere) {
  const test::Triangles t = test::sphere(2, .35, 2);
  test::WorkingScene s(t, test::unit_sphere());
  ASSERT_GT(flip_to_delaunay(s.mesh), 0);
  for (const Triangle& f : s.halfedges.faces())
    EXPECT_GE(face_alignment(s.positions.points, s.positions.normals, f), .3);
  for (int v = 0; v < t.points.cols(); ++v) EXPECT_GE(s.halfedges.valence(v), 3);
}

TEST(EdgeFlips, AFoldThatIsThereIsNoLeaveForAnother) {
  test::Triangles t = test::sphere(2, .35, 2);
  for (Eigen::Index v = 0; v < t.points.cols(); ++v)
    t.points.col(v) *= 1 + .35 * std::sin(static_cast<double>(7 * v));
  const Surface rough = [](const Vec3& x, int hint, double) {
    return Projection{x, x.normalized(), hint, ProjectionStatus::converged, 1};
  };
  test::WorkingScene s(t, rough);
  const double limit = ShapeLimits().fold;
  const auto cosine = [&](int a, int b) {
    const int h = test::half_edge(s.halfedges, a, b);
    return cosine_between(s.positions.points, s.halfedges.faces()[h / 3],
                          s.halfedges.faces()[s.halfedges.twin(h) / 3]);
  };
  int allowed = 0, beside_folds = 0;
  for (int h = 0; h < s.halfedges.half_edge_count(); ++h) {
    const int a = s.halfedges.from(h), b = s.halfedges.to(h), c = s.halfedges.opposite_vertex(h),
              d = s.halfedges.opposite_vertex(s.halfedges.twin(h));
    if (!may_flip(s.mesh, h)) continue;
    const std::array<Edge, 4> quad_edges = {Edge{b, c}, Edge{c, a}, Edge{a, d}, Edge{d, b}};
    std::vector<double> before = {cosine(a, b)};
    for (const auto& [from, to] : quad_edges) before.push_back(cosine(from, to));
    const HalfedgeMesh kept = s.halfedges;
    s.halfedges.flip(h);
    std::vector<double> after = {cosine(c, d)};
    for (const auto& [from, to] : quad_edges) after.push_back(cosine(from, to));
    s.halfedges = kept;
    for (size_t i = 0; i < before.size(); ++i) EXPECT_GE(after[i], std::min(limit, before[i]));
    ++allowed;
    beside_folds += *std::ranges::min_element(before) < limit;
  }
  EXPECT_GT(allowed, 0);
  EXPECT_GT(beside_folds, 0);
}

TEST(EdgeFlips, AConvexQuadMayFlipAndADentedOneMayNot) {
  test::WorkingScene convex(quad(Vec3(1, 1, 0)), test::plane());
  convex.vertices.corner_valences = {2, 2, 3, 3};  // vertices 0 and 2 have three edges
  EXPECT_FALSE(may_flip(convex.mesh, test::half_edge(convex.halfedges, 0, 2)));
  convex.vertices.corner_valences = {2, 3, 2, 3};
  EXPECT_TRUE(may_flip(convex.mesh, test::half_edge(convex.halfedges, 0, 2)));

  test::WorkingScene dented(quad(Vec3(.3, .3, 0)), test::plane());
  dented.vertices.corner_valences = {2, 3, 2, 3};
  EXPECT_FALSE(may_flip(dented.mesh, test::half_edge(dented.halfedges, 0, 2)));
  test::WorkingScene sliver(quad(Vec3(.501, .501, 0)), test::plane());
  sliver.vertices.corner_valences = {2, 3, 2, 3};
  EXPECT_FALSE(may_flip(sliver.mesh, test::half_edge(sliver.halfedges, 0, 2)));
  EXPECT_TRUE(flip_keeps_topology(sliver.mesh, test::half_edge(sliver.halfedges, 0, 2)));
}

TEST(EdgeFlips, NoEdgeIsDoubled) {
  test::Triangles t;
  t.points.resize(3, 4);
  t.points << 1, -1, -1, 1, 1, -1, 1, -1, 1, 1, -1, -1;
  t.faces = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
  test::WorkingScene s(t, test::unit_sphere());
  for (int h = 0; h < 12; ++h) {
    s.vertices.corner_valences.assign(
        4,
        4);  // valences forbid nothing: the ends may lose an edge, the others gain one
    for (int end : {s.halfedges.from(h), s.halfedges.to(h)}) s.vertices.corner_valences[end] = 2;
    EXPECT_FALSE(flip_keeps_topology(s.mesh, h));
  }
}

TEST(EdgeFlips, AVertexKeepsThreeEdges) {
  test::WorkingScene s(fan_in_square(Vec3(.6, .55, 0)), test::plane());
  ASSERT_EQ(s.halfedges.valence(4), 4);
  for (int h : s.halfedges.outgoing(4)) EXPECT_FALSE(may_flip(s.mesh, h));  // the ends have three
  s.vertices.corner_valences = {2, 2, 2, 2, 0};
  for (int h : s.halfedges.outgoing(4)) EXPECT_FALSE(may_flip(s.mesh, h));  // target valence of corners
  s.vertices.corner_valences = {2, 4, 2, 4, 0};
  EXPECT_TRUE(may_flip(s.mesh, test::half_edge(s.halfedges, 4, 0)));
  s.halfedges.flip(test::half_edge(s.halfedges, 4, 0));
  ASSERT_EQ(s.halfedges.valence(4), 3);
  for (int h : s.halfedges.outgoing(4)) EXPECT_FALSE(may_flip(s.mesh, h));
}

TEST(EdgeFlips, AnEdgeDoesNotCutThroughASharpBend) {
  test::WorkingScene s(quad(Vec3(1, 1, 0)), test::plane());
  s.vertices.corner_valences = {2, 3, 2, 3};
  const int h = test::half_edge(s.halfedges, 0, 2);
  ASSERT_TRUE(may_flip(s.mesh, h));
  s.positions.normals.col(1) = Vec3(.8, -.6, .1).normalized();  // the new edge would join 1 and 3
  s.positions.normals.col(3) = Vec3(-.6, .8, .1).normalized();
  EXPECT_FALSE(may_flip(s.mesh, h));
  for (double& length : s.vertices.vertex_length) length *= 100;  // for which it is short
  EXPECT_TRUE(may_flip(s.mesh, h));
}

}  // namespace hooke::edge_flips_test
