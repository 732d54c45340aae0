#include "hooke/mesh/mesh.h"

#include <gtest/gtest.h>

#include "hooke/core/error.h"
#include "solids.h"

namespace hooke {
namespace {

TEST(MeshFoundation, TrianglesComeBackAsTheyWentIn) {
  for (const test::Triangles& t : {test::cube(), test::tetrahedron(), test::grid(3, test::flat)}) {
    const TriMesh mesh = test::to_mesh(t);
    EXPECT_EQ(triangles_of(mesh), t.faces);
    EXPECT_EQ(positions(mesh), t.points);
  }
}

TEST(MeshFoundation, PositionsAreTheMeshsOwnStorage) {
  TriMesh mesh = test::to_mesh(test::cube());
  positions(mesh).col(3) = Vec3(7, 8, 9);
  EXPECT_EQ(mesh.point(mesh.vertex_handle(3)), Vec3(7, 8, 9));
  mesh.set_point(mesh.vertex_handle(0), Vec3(-1, -2, -3));
  EXPECT_EQ(positions(mesh).col(0), Vec3(-1, -2, -3));
}

TEST(MeshFoundation, AnEmptyMeshHasEmptyMatrices) {
  TriMesh mesh;
  EXPECT_EQ(positions(mesh).cols(), 0);
  VProp<Vec3> velocity(mesh, velocity_property);
  EXPECT_EQ(as_matrix(mesh, velocity).cols(), 0);
  EXPECT_TRUE(triangles_of(mesh).empty());
}

TEST(MeshFoundation, VerticesWithoutFacesKeepTheirIds) {
  const TriMesh mesh = build_mesh(Mat3X::Random(3, 6), {{1, 3, 5}});
  EXPECT_EQ(mesh.n_vertices(), 6u);
  EXPECT_EQ(triangles_of(mesh), (std::vector<Triangle>{{1, 3, 5}}));
}

TEST(MeshFoundation, ValuesAreStoredByVertexId) {
  TriMesh mesh = test::to_mesh(test::tetrahedron());
  set_vertex_values(mesh, target_length_property, 2.5);
  EXPECT_EQ(vertex_values(mesh, target_length_property), std::vector<double>(4, 2.5));
  set_vertex_values(mesh, target_length_property, 3);
  EXPECT_EQ(vertex_values(mesh, target_length_property), std::vector<double>(4, 3));
}

TEST(MeshFoundation, AMissingPropertyIsAnError) {
  const TriMesh mesh = test::to_mesh(test::tetrahedron());
  EXPECT_THROW(vertex_values(mesh, target_length_property), Error);
}

TEST(MeshFoundation, AFaceThatDoesNotFitIsAnError) {
  // A third face on the edge 0 1, and a second face that runs through it the same way.
  EXPECT_THROW(build_mesh(Mat3X::Random(3, 5), {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}), MeshError);
  EXPECT_THROW(build_mesh(Mat3X::Random(3, 4), {{0, 1, 2}, {0, 1, 3}}), MeshError);
}

}  // namespace
}  // namespace hooke
