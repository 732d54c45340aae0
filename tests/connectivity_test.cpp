#include "hooke/mesh/adjacency.h"

#include <gtest/gtest.h>

#include "meshes.h"

namespace hooke {
namespace {

TEST(Connectivity, EulerCharacteristicOfASphereIsTwo) {
  const auto t = test::sphere(2);
  const Connectivity c = make_connectivity(static_cast<int>(t.points.cols()), t.faces);
  EXPECT_EQ(c.vertex_count - static_cast<int>(c.edges.size()) + static_cast<int>(c.faces.size()), 2);
  for (size_t e = 0; e < c.edges.size(); ++e) EXPECT_FALSE(c.is_boundary_edge(static_cast<int>(e)));
}

TEST(Connectivity, EdgesKnowTheirFacesAndFacesTheirEdges) {
  const auto t = test::grid(5, test::flat);
  const Connectivity c = make_connectivity(static_cast<int>(t.points.cols()), t.faces);
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
  EXPECT_EQ(positions(mesh), t.points);
  VProp<Vec3> velocity(mesh, velocity_property);
  as_matrix(mesh, velocity).setConstant(3);
  EXPECT_EQ(velocity[mesh.vertex_handle(5)], Vec3(3, 3, 3));
}

}  // namespace
}  // namespace hooke
