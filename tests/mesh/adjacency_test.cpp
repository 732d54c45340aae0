#include "hooke/mesh/adjacency.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/meshes.h"
#include "support/solids.h"

#include "hooke/mesh/mesh.h"

namespace hooke::adjacency_test {

TEST(Adjacency, EulerCharacteristicOfASphereIsTwo) {
  const auto t = test::sphere(2);
  const Adjacency c = make_adjacency(static_cast<int>(t.points.cols()), t.faces);
  EXPECT_EQ(c.vertex_count - static_cast<int>(c.edges.size()) + static_cast<int>(c.faces.size()), 2);
  for (size_t e = 0; e < c.edges.size(); ++e) EXPECT_FALSE(c.is_boundary_edge(static_cast<int>(e)));
}

TEST(Adjacency, EdgesKnowTheirFacesAndFacesTheirEdges) {
  const auto t = test::grid(5, test::flat);
  const Adjacency c = make_adjacency(static_cast<int>(t.points.cols()), t.faces);
  int boundary = 0;
  for (size_t e = 0; e < c.edges.size(); ++e) boundary += c.is_boundary_edge(static_cast<int>(e));
  EXPECT_EQ(boundary, 4 * 5);
  for (size_t f = 0; f < c.faces.size(); ++f)
    for (size_t k = 0; k < 3; ++k) {
      const auto e = static_cast<size_t>(c.face_edges[f][k]);
      EXPECT_TRUE(c.edge_faces[e][0] == static_cast<int>(f) || c.edge_faces[e][1] == static_cast<int>(f));
      const auto [lo, hi] = std::minmax(c.faces[f][k], c.faces[f][(k + 1) % 3]);
      EXPECT_EQ(std::min(c.edges[e][0], c.edges[e][1]), lo);
      EXPECT_EQ(std::max(c.edges[e][0], c.edges[e][1]), hi);
    }
}

TEST(Mesh, KeepsIdsAndPointsOfTheArraysItWasBuiltFrom) {
  const auto t = test::sphere(1, .2);
  TriMesh mesh = test::to_mesh(t);
  EXPECT_EQ(triangles_of(mesh), t.faces);
  EXPECT_EQ(vertex_points(mesh), t.points);
  VProp<Vec3> velocity(mesh, velocity_property);
  as_matrix(mesh, velocity).setConstant(3);
  EXPECT_EQ(velocity[mesh.vertex_handle(5)], Vec3(3, 3, 3));
}

std::vector<Fan> kinds(int vertices, const std::vector<Triangle>& faces) {
  return examine_fans(vertices, faces).kinds;
}

TEST(VertexFans, ManifoldsHaveFansOnly) {
  for (const test::Triangles& t : {test::tetrahedron(), test::sphere(2), test::grid(5, test::flat)}) {
    const VertexFans fans = examine_fans(static_cast<int>(t.points.cols()), t.faces);
    EXPECT_EQ(first_broken(fans), -1);
    EXPECT_EQ(std::count(fans.kinds.begin(), fans.kinds.end(), Fan::whole), t.points.cols());
  }
}

TEST(VertexFans, AHalfEdgeIsTheTwinOfItsTwinAndRunsBack) {
  const test::Triangles t = test::grid(6, test::flat);
  const VertexFans fans = examine_fans(static_cast<int>(t.points.cols()), t.faces);
  const auto from = [&](int h) { return t.faces[h / 3][h % 3]; };
  const auto to = [&](int h) { return t.faces[h / 3][(h + 1) % 3]; };
  int boundary = 0;
  for (int h = 0; h < static_cast<int>(fans.twins.size()); ++h) {
    const int twin = fans.twins[h];
    boundary += twin < 0;
    if (twin < 0) continue;
    EXPECT_EQ(fans.twins[twin], h);
    EXPECT_EQ(from(h), to(twin));
    EXPECT_EQ(to(h), from(twin));
  }
  EXPECT_EQ(boundary, 4 * 6);
}

TEST(VertexFans, WhatIsNotAnOrientedManifoldIsBroken) {
  const std::vector<Triangle> three_on_an_edge = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  EXPECT_EQ(kinds(5, three_on_an_edge)[0], Fan::broken);
  EXPECT_EQ(kinds(5, three_on_an_edge)[2], Fan::whole);
  const std::vector<Triangle> turned = {{0, 1, 2}, {0, 1, 3}};
  EXPECT_EQ(kinds(4, turned)[0], Fan::broken);
  EXPECT_EQ(kinds(4, turned)[1], Fan::broken);
  const std::vector<Triangle> touching = {{0, 1, 2}, {0, 3, 4}};
  EXPECT_EQ(kinds(5, touching),
            (std::vector<Fan>{Fan::broken, Fan::whole, Fan::whole, Fan::whole, Fan::whole}));
  EXPECT_EQ(kinds(3, {{0, 1, 2}, {0, 1, 2}}), std::vector<Fan>(3, Fan::broken));
  EXPECT_EQ(kinds(3, {{0, 1, 2}, {0, 2, 1}}), std::vector<Fan>(3, Fan::broken));
}

TEST(VertexFans, AnOpenAndAClosedFanAtOneVertexAreBroken) {
  std::vector<Triangle> faces = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}};  // closed
  faces.push_back({0, 4, 5});
  EXPECT_EQ(kinds(6, faces)[0], Fan::broken);
  faces.insert(faces.end(), {{0, 5, 6}, {0, 6, 4}});  // two closed ones
  EXPECT_EQ(kinds(7, faces)[0], Fan::broken);
}

TEST(VertexFans, VerticesWithoutFacesAreIsolated) {
  EXPECT_EQ(kinds(4, {{0, 1, 3}})[2], Fan::isolated);
}

TEST(VertexFans, AHubOfManyFacesIsNoSlowerThanItsFaces) {
  constexpr int face_count = 100000;
  std::vector<Triangle> faces;
  for (int k = 1; k <= face_count; ++k) faces.push_back({0, k, k % face_count + 1});
  const VertexFans fans = examine_fans(face_count + 1, faces);
  EXPECT_EQ(first_broken(fans), -1);
  EXPECT_EQ(std::count(fans.twins.begin(), fans.twins.end(), -1), face_count);
}

}  // namespace hooke::adjacency_test
