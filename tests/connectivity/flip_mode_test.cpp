#include "hooke/connectivity/flip_mode.h"

#include <gtest/gtest.h>

#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"
#include "hooke/measure/quality.h"
#include "hooke/mesh/extent.h"
#include "hooke/mesh/mesh.h"
#include "hooke/mesh/topology.h"
#include "hooke/remesh/options.h"
#include "hooke/remesh/remesh.h"
#include "hooke/remesh/result.h"
#include "support/remeshed.h"
#include "support/working_scene.h"

namespace hooke::flip_mode_test {

TriMesh with_target(const test::Triangles& t) {
  TriMesh mesh = test::to_mesh(t);
  set_vertex_values(mesh, target_length_property,
                    natural_length(total_area(t.points, t.faces), t.faces.size()));
  return mesh;
}

RemeshOptions flipping(Effort effort) {
  RemeshOptions options;
  options.connectivity = ConnectivityMode::flip;
  options.effort = effort;
  return options;
}

double wave(double x, double y) {
  return .1 * std::sin(5 * x) * std::cos(4 * y);
}

class FlipEfforts : public testing::TestWithParam<Effort> {};

TEST_P(FlipEfforts, GiveGoodTrianglesOnTheSameSurfaceAndKeepTheBoundary) {
  const test::Triangles t = test::grid(16, wave, .45, 4);
  TriMesh mesh = with_target(t);
  const RemeshResult result = remesh(mesh, flipping(GetParam()));
  const std::vector<Triangle> faces = triangles_of(mesh);
  const Mat3X points = vertex_points(mesh);
  const int n = static_cast<int>(points.cols());
  EXPECT_GT(min_angle(points, faces), 30);
  EXPECT_LT(min_angle(t.points, t.faces), 10);
  EXPECT_TRUE(test::turned_faces(t, mesh).empty());
  EXPECT_EQ(faces.size(), t.faces.size());
  EXPECT_EQ(test::boundary_edges(n, faces), test::boundary_edges(n, t.faces));
  double worst = 0;
  for (int v = 0; v < n; ++v)
    worst = std::max(worst, std::abs(points(2, v) - wave(points(0, v), points(1, v))));
  EXPECT_LT(worst, .1 * natural_length(1, faces.size()));
}
INSTANTIATE_TEST_SUITE_P(All, FlipEfforts, testing::Values(Effort::fast, Effort::standard, Effort::thorough));

TEST(FlipConnectivity, TellsHowFarVerticesTravelled) {
  const test::Triangles t = test::sphere(3, .4, 4);
  TriMesh mesh = with_target(t);
  const double L = natural_length(total_area(t.points, t.faces), t.faces.size());
  const RemeshResult result = remesh(mesh, flipping(Effort::fast));
  const Mat3X moved = vertex_points(mesh) - t.points;
  EXPECT_NEAR(result.flips.max_travel, moved.colwise().norm().maxCoeff() / L, 1e-9);
  EXPECT_NEAR(result.flips.rms_travel, moved.norm() / std::sqrt(double(t.points.cols())) / L, 1e-9);
  EXPECT_GT(result.flips.flips, 0);
}

TEST(FlipConnectivity, VertexPropertiesAreKept) {
  const test::Triangles t = test::sphere(2, .4, 4);
  TriMesh mesh = with_target(t);
  auto mark = OpenMesh::getOrMakeProperty<OpenMesh::VertexHandle, int>(mesh, "v:mark");
  for (const auto v : mesh.vertices()) mark[v] = 7 * v.idx();
  remesh(mesh, flipping(Effort::fast));
  ASSERT_NE(triangles_of(mesh), t.faces);
  auto kept = OpenMesh::getProperty<OpenMesh::VertexHandle, int>(mesh, "v:mark");
  for (const auto v : mesh.vertices()) EXPECT_EQ(kept[v], 7 * v.idx());
  EXPECT_NO_THROW(vertex_values(mesh, target_length_property));
}

TEST(FlipConnectivity, FacesThatWereNotFlippedKeepTheirIdsAndCorners) {
  const test::Triangles t = test::grid(8, test::flat, .2, 4);
  TriMesh mesh = with_target(t);
  remesh(mesh, flipping(Effort::fast));
  const std::vector<Triangle> faces = triangles_of(mesh);
  int same = 0;
  for (size_t f = 0; f < faces.size(); ++f) same += faces[f] == t.faces[f];
  EXPECT_GT(same, 10);
}

TEST(FlipConnectivity, ModeFixedFlipsNothing) {
  const test::Triangles t = test::sphere(2, .4, 4);
  TriMesh mesh = with_target(t);
  EXPECT_EQ(remesh(mesh, {}).flips.flips, 0);
  EXPECT_EQ(triangles_of(mesh), t.faces);
}

TEST(FlipConnectivity, OneThreadAndTwoGiveTheSameBits) {
  const test::Triangles t = test::grid(12, wave, .45, 4);
  TriMesh one = with_target(t), two = with_target(t);
  {
    ThreadLimit limit(1);
    remesh(one, flipping(Effort::thorough));
  }
  {
    ThreadLimit limit(2);
    remesh(two, flipping(Effort::thorough));
  }
  EXPECT_EQ(vertex_points(one), vertex_points(two));
  EXPECT_EQ(triangles_of(one), triangles_of(two));
}

TEST(FlipConnectivity, AnInterruptedRunLeavesAValidMesh) {
  const test::Triangles t = test::grid(12, wave, .45, 4);
  for (int calls : {0, 3, 25, 70}) {
    TriMesh mesh = with_target(t);
    int left = calls;
    const RemeshResult result =
        remesh(mesh, flipping(Effort::standard), [&](const Progress&) { return left-- > 0; });
    EXPECT_EQ(result.reason, StopReason::interrupted) << calls;
    const int n = static_cast<int>(t.points.cols());
    EXPECT_EQ(measure_topology(make_adjacency(n, triangles_of(mesh))).euler, 1);
    EXPECT_TRUE(test::turned_faces(t, mesh).empty());
    EXPECT_TRUE(vertex_points(mesh).allFinite());
  }
}

}  // namespace hooke::flip_mode_test
