#include "hooke/mesh/valid_mesh.h"

#include <gtest/gtest.h>

#include "hooke/core/error.h"
#include "support/meshes.h"

namespace hooke::valid_mesh_test {

TEST(ValidMesh, KeepsPointsFacesAndTheirOrder) {
  const test::Triangles t = test::sphere(2, .2);
  const ValidMesh valid = make_valid_mesh(t.points, t.faces, "sphere");
  EXPECT_EQ(vertex_points(valid.mesh), t.points);
  EXPECT_EQ(triangles_of(valid.mesh), t.faces);
  EXPECT_TRUE(valid.warnings.empty());
}

TEST(ValidMesh, HasTheMemoryOrderOfItsMesh) {
  const test::Triangles t = test::grid(9, test::paraboloid, .3);
  const ValidMesh valid = make_valid_mesh(t.points, t.faces, "grid");
  const MemoryOrder found = find_memory_order(valid.mesh);
  EXPECT_EQ(valid.memory_order.order.old_vertex, found.order.old_vertex);
  EXPECT_EQ(valid.memory_order.order.old_face, found.order.old_face);
  EXPECT_EQ(valid.memory_order.adjacency->faces, found.adjacency->faces);
  EXPECT_EQ(valid.memory_order.adjacency->edges, found.adjacency->edges);
}

TEST(ValidMesh, RefusesByTheNameGiven) {
  test::Triangles t = test::sphere(1);
  for (int wrong : {-1, 1000}) {
    std::vector<Triangle> faces = t.faces;
    faces[7][1] = wrong;
    try {
      make_valid_mesh(t.points, faces, "mine");
      FAIL() << wrong;
    } catch (const MeshError& e) {
      EXPECT_EQ(std::string(e.what()).rfind("mine: ", 0), 0u) << e.what();
    }
  }
  EXPECT_THROW(make_valid_mesh(t.points, {}, "mine"), MeshError);
  EXPECT_THROW(make_valid_mesh(Mat3X(3, 0), {}, "mine"), MeshError);
  EXPECT_THROW(make_valid_mesh(1e-60 * t.points, t.faces, "mine"), MeshError);
}

TEST(ValidMesh, WarnsOfWhatIsAcceptable) {
  test::Triangles t = test::sphere(1);
  t.points.conservativeResize(3, t.points.cols() + 1);
  t.points.rightCols(1).setZero();
  const ValidMesh valid = make_valid_mesh(t.points, t.faces, "mine");
  ASSERT_EQ(valid.warnings.size(), 1u);
  EXPECT_EQ(valid.warnings[0].code, "isolated_vertices");
}

TEST(ValidMesh, IsMendedIfAskedTo) {
  const test::Triangles t = test::sphere(1);
  std::vector<Triangle> faces = t.faces;
  std::swap(faces[3][1], faces[3][2]);
  faces.push_back(faces[5]);
  EXPECT_THROW(make_valid_mesh(t.points, faces, "mine", {}), MeshError);
  const ValidMesh valid = make_valid_mesh(t.points, faces, "mine", {.repair = true});
  EXPECT_EQ(triangles_of(valid.mesh), t.faces);
  EXPECT_EQ(vertex_points(valid.mesh), t.points);
  EXPECT_EQ(valid.repairs.size(), 2u);
  EXPECT_TRUE(valid.origin.flipped[3]);
}

TEST(ValidMesh, OfAGoodMeshIsTheSameAfterARepair) {
  const test::Triangles t = test::grid(5, test::paraboloid, .3);
  const ValidMesh valid = make_valid_mesh(t.points, t.faces, "mine", {.repair = true});
  EXPECT_EQ(triangles_of(valid.mesh), t.faces);
  EXPECT_EQ(vertex_points(valid.mesh), t.points);
  EXPECT_TRUE(valid.repairs.empty());
}

}  // namespace hooke::valid_mesh_test
