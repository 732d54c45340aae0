#include "hooke/connectivity/corner_flips.h"

#include <gtest/gtest.h>

#include "support/working_scene.h"

#include "hooke/connectivity/edge_flips.h"
#include "hooke/constraints/constraints.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/adjacency.h"

namespace hooke::corner_flips_test {

int target_valence_at_tip(double angle) {
  const test::Triangles t = test::fan(angle, 4);
  const Adjacency c = make_adjacency(static_cast<int>(t.points.cols()), t.faces);
  return corner_valences(t.points, c, find_constraints(t.points, c, {}))[0];
}

TEST(CornerFlips, ACornerTargetsFacesOfAboutSixtyDegrees) {
  EXPECT_EQ(target_valence_at_tip(20), 2);  // at least one face
  EXPECT_EQ(target_valence_at_tip(42), 2);
  EXPECT_EQ(target_valence_at_tip(95), 3);
  EXPECT_EQ(target_valence_at_tip(125), 3);
  EXPECT_EQ(target_valence_at_tip(250), 5);
}

TEST(CornerFlips, OnlyCornersOfTheBoundaryHaveATarget) {
  EXPECT_EQ(target_valence_at_tip(170), 0);  // nearly straight
  const test::Triangles t = test::grid(4, test::flat);
  const Adjacency c = make_adjacency(25, t.faces);
  const std::vector<int> targets = corner_valences(t.points, c, find_constraints(t.points, c, {}));
  EXPECT_EQ(std::count(targets.begin(), targets.end(), 0), 21);
  const test::Triangles ball = test::sphere(1);
  const Adjacency closed = make_adjacency(42, ball.faces);
  for (int v : corner_valences(ball.points, closed, find_constraints(ball.points, closed, {})))
    EXPECT_EQ(v, 0);
}

struct Fan {
  double angle;
  int edge_count;
};
class CornerIsForced : public testing::TestWithParam<Fan> {};

TEST_P(CornerIsForced, ToItsTargetValenceAndStaysThere) {
  const test::Triangles t = test::fan(GetParam().angle, GetParam().edge_count);
  test::WorkingScene s(t, test::plane());
  s.vertices.corner_valences = corner_valences(t.points, s.adjacency, s.constraints);
  const Vec3 tip = s.positions.points.col(0);
  EXPECT_GT(flip_corners_to_valence(s.mesh), 0);
  EXPECT_EQ(s.halfedges.valence(0), s.vertices.corner_valences[0]);
  EXPECT_EQ(Vec3(s.positions.points.col(0)), tip);
  flip_to_delaunay(s.mesh);
  EXPECT_EQ(s.halfedges.valence(0), s.vertices.corner_valences[0]);
  for (const Triangle& f : s.halfedges.faces())
    EXPECT_GE(face_alignment(s.positions.points, s.positions.normals, f), .3);
  const int n = static_cast<int>(t.points.cols());
  EXPECT_EQ(test::boundary_edges(n, s.halfedges.faces()), test::boundary_edges(n, t.faces));
}
INSTANTIATE_TEST_SUITE_P(Fans, CornerIsForced,
                         testing::Values(Fan{42, 3}, Fan{42, 4}, Fan{90, 5}, Fan{130, 7}));

TEST(CornerFlips, ACornerCutOffByOneFaceIsOpened) {
  const test::Triangles t = test::grid(4, test::flat);
  test::WorkingScene s(t, test::plane());
  s.vertices.corner_valences = corner_valences(t.points, s.adjacency, s.constraints);
  for (int corner : {4, 20}) ASSERT_EQ(s.halfedges.valence(corner), 2);
  EXPECT_EQ(flip_corners_to_valence(s.mesh), 2);
  for (int corner : {0, 4, 20, 24}) EXPECT_EQ(s.halfedges.valence(corner), 3);
  EXPECT_EQ(s.positions.points, t.points);
}

TEST(CornerFlips, AnInnerNeighbourDeepInTheEarIsMovedOutOfIt) {
  test::Triangles t = test::fan(42, 3);
  t.points.col(2) *= .6;  // behind the line between its neighbours: the edge to it cannot be flipped directly
  test::WorkingScene s(t, test::plane());
  s.vertices.corner_valences = corner_valences(t.points, s.adjacency, s.constraints);
  ASSERT_FALSE(may_flip(s.mesh, test::half_edge(s.halfedges, 0, 2)));
  flip_corners_to_valence(s.mesh);
  EXPECT_EQ(s.halfedges.valence(0), 2);
}

TEST(CornerFlips, WhatBringsNothingIsUndone) {
  // The neighbour of the tip has no room: its ring is one face behind it.
  const test::Triangles t{(Mat3X(3, 4) << 0, 1, .4, 0, 0, 0, .4, 1, 0, 0, 0, 0).finished(),
                          {{0, 1, 2}, {0, 2, 3}}};
  test::WorkingScene s(t, test::plane());
  s.constraints.freedom.assign(4, Freedom::fixed);
  s.vertices.corner_valences = {2, 2, 3, 2};
  EXPECT_EQ(flip_corners_to_valence(s.mesh), 0);
  EXPECT_EQ(s.positions.points, t.points);
  EXPECT_EQ(s.halfedges.faces(), t.faces);
}

}  // namespace hooke::corner_flips_test
