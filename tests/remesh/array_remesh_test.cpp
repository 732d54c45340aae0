#include "hooke/remesh/array_remesh.h"

#include <gtest/gtest.h>

#include "hooke/core/error.h"
#include "support/meshes.h"

namespace hooke::array_remesh_test {

struct Arrays {
  Eigen::MatrixX3d vertices;
  Eigen::MatrixX3i faces;
};

Arrays arrays_of(const test::Triangles& t) {
  Arrays arrays{t.points.transpose(), Eigen::MatrixX3i(std::ssize(t.faces), 3)};
  for (Eigen::Index f = 0; f < arrays.faces.rows(); ++f)
    arrays.faces.row(f) = Eigen::Map<const Eigen::RowVector3i>(t.faces[f].data());
  return arrays;
}

TEST(ArrayRemesh, IsThatOfTheMesh) {
  const test::Triangles t = test::sphere(2, .3);
  const Arrays input = arrays_of(t);
  const RemeshedArrays done = preserving_remesh(input.vertices, input.faces);

  TriMesh mesh = test::to_mesh(t);
  MemoryOrder order = find_memory_order(mesh);
  set_target_lengths(mesh, order);
  preserving_remesh(mesh, std::move(order), {});
  EXPECT_EQ(done.vertices, vertex_points(mesh).transpose());
  EXPECT_EQ(done.faces, input.faces);
  EXPECT_GT(done.result.measures->quality.min_angle.min, done.result.measures->input_quality.min_angle.min);
}

TEST(ArrayRemesh, AdaptsToTheLength) {
  const Arrays input = arrays_of(test::sphere(3, .3));
  RemeshOptions options;
  options.connectivity = ConnectivityMode::adapt;
  options.effort = Effort::fast;
  const RemeshedArrays done = preserving_remesh(input.vertices, input.faces, options, parse_length("2x"));
  EXPECT_NEAR(static_cast<double>(done.faces.rows()), static_cast<double>(input.faces.rows()) / 4, 20);
  EXPECT_EQ(done.faces.maxCoeff() + 1, done.vertices.rows());
  EXPECT_TRUE(done.result.measures->preservation.holds());
}

TEST(ArrayRemesh, StopsWhenTheObserverSaysSo) {
  const Arrays input = arrays_of(test::sphere(3, .3));
  const RemeshedArrays done =
      preserving_remesh(input.vertices, input.faces, {}, {}, {}, [](const Progress&) { return false; });
  EXPECT_EQ(done.result.reason, StopReason::interrupted);
  EXPECT_TRUE(done.vertices.allFinite());
}

TEST(ArrayRemesh, RefusesWhatIsNoMesh) {
  Arrays input = arrays_of(test::sphere(1));
  input.faces(3, 1) = 1000;
  EXPECT_THROW(preserving_remesh(input.vertices, input.faces), MeshError);
}

}  // namespace hooke::array_remesh_test
