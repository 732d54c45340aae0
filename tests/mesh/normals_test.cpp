#include "hooke/mesh/normals.h"

#include <gtest/gtest.h>

#include "support/meshes.h"

#include "hooke/mesh/adjacency.h"

namespace hooke::normals_test {

TEST(Normals, OfVerticesOnASphereAreItsRadii) {
  const auto t = test::sphere(2, .3);
  const Adjacency c = make_adjacency(static_cast<int>(t.points.cols()), t.faces);
  EXPECT_LT((vertex_normals(t.points, c) - t.points).cwiseAbs().maxCoeff(), 1e-12);
  const Mat3X of_faces = face_normals(t.points, c);
  for (Eigen::Index f = 0; f < of_faces.cols(); ++f) {
    EXPECT_NEAR(of_faces.col(f).norm(), 1, 1e-15);
    EXPECT_GT(of_faces.col(f).dot(t.points.col(c.faces[f][0])), 0);
  }
}

TEST(Normals, OfAFlatGridPointUp) {
  const auto t = test::grid(6, test::flat, .3);
  const Adjacency c = make_adjacency(static_cast<int>(t.points.cols()), t.faces);
  EXPECT_EQ(vertex_normals(t.points, c), Vec3::UnitZ().replicate(1, t.points.cols()));
}

TEST(Normals, AreZeroWhereThereIsNoArea) {
  Mat3X points(3, 5);
  points << 0, 1, 2, 0, 7, 0, 0, 0, 0, 7, 0, 0, 0, 0, 7;  // a face without area, one folded to a point, none
  const Adjacency c = make_adjacency(5, {{0, 1, 2}, {0, 2, 3}});
  EXPECT_TRUE(vertex_normals(points, c).isZero(0));
  EXPECT_TRUE(face_normals(points, c).isZero(0));
  const Eigen::VectorXd lengths = mean_edge_lengths(points, c);
  EXPECT_EQ(lengths[4], 0);
  EXPECT_EQ(lengths[1], 1);
}

}  // namespace hooke::normals_test
