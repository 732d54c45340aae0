#include "hooke/remesh/array_remesh.h"

#include <gtest/gtest.h>

#include <cmath>

#include "hooke/core/error.h"
#include "support/meshes.h"
#include "support/solids.h"

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

/// Standard deviation over the mean of the edges between vertices below `end` and from `begin` on.
double edge_variation(const RemeshedArrays& mesh, int begin, int end) {
  double count = 0, sum = 0, squares = 0;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
    for (Eigen::Index k = 0; k < 3; ++k) {
      const int v = mesh.faces(f, k), w = mesh.faces(f, (k + 1) % 3);
      if (v < begin || v >= end) continue;
      const double length = (mesh.vertices.row(v) - mesh.vertices.row(w)).norm();
      ++count;
      sum += length;
      squares += length * length;
    }
  return std::sqrt(squares / count - std::pow(sum / count, 2)) / (sum / count);
}

/// A ball of this size, moved aside.
test::Triangles ball_beside(int levels, double radius) {
  test::Triangles ball = test::sphere(levels, .35, 5);
  ball.points *= radius;
  ball.points.row(0).array() += 3 * radius;
  return ball;
}

TEST(ArrayRemesh, APartIsAsGoodAsAlone) {
  const test::Triangles fine = test::sphere(3, .35, 4), coarse = ball_beside(2, 9);
  const auto fines = static_cast<int>(fine.points.cols()), coarses = static_cast<int>(coarse.points.cols());
  for (const ConnectivityMode mode : {ConnectivityMode::fixed, ConnectivityMode::flip}) {
    RemeshOptions options;
    options.connectivity = mode;
    const auto remeshed = [&](const test::Triangles& t) {
      const Arrays input = arrays_of(t);
      return preserving_remesh(input.vertices, input.faces, options);
    };
    const RemeshedArrays both = remeshed(test::both(fine, coarse));
    EXPECT_LT(edge_variation(both, 0, fines), 1.05 * edge_variation(remeshed(fine), 0, fines));
    EXPECT_LT(edge_variation(both, fines, fines + coarses),
              1.05 * edge_variation(remeshed(coarse), 0, coarses));
  }
}

TEST(ArrayRemesh, ASmallPartKeepsItsShapeBesideALargeOne) {
  const test::Triangles small = test::sphere(2, .3), large = ball_beside(2, 9);
  const Arrays input = arrays_of(test::both(small, large));
  RemeshOptions options;
  options.connectivity = ConnectivityMode::adapt;
  const RemeshedArrays done = preserving_remesh(input.vertices, input.faces, options);
  const auto is_small = [&](Eigen::Index f) { return done.vertices(done.faces(f, 0), 0) < 2; };
  int faces = 0;
  for (Eigen::Index f = 0; f < done.faces.rows(); ++f) faces += is_small(f);
  EXPECT_NEAR(faces, std::ssize(small.faces), .1 * static_cast<double>(small.faces.size()));
  EXPECT_LT(done.faces.rows(), 2 * input.faces.rows());
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
