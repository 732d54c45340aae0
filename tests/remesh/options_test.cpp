// What sizing and effort do to a remeshing.
#include <gtest/gtest.h>

#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/mesh.h"
#include "hooke/remesh/options.h"
#include "hooke/springs/sizing.h"
#include "hooke/springs/target_lengths.h"
#include "support/remeshed.h"
#include "support/solids.h"

namespace hooke::options_test {

using test::Outcome, test::remeshed;

double wave(double x, double y) {
  return .12 * std::sin(4 * x) * std::cos(3 * y);
}
test::Triangles jittered_grid() {
  return test::grid(9, wave, .35, 4);
}

/// A sphere with evenly dense vertices and target lengths that vary by 4 from pole to pole.
TriMesh graded_sphere() {
  const test::Triangles t = test::sphere(3, .3, 4);
  Sizing sizing;
  for (const auto p : t.points.colwise()) sizing.vertex_length.push_back(2.5 + 1.5 * p[2]);
  TriMesh mesh = test::to_mesh(t);
  set_vertex_values(mesh, target_length_property,
                    resolve_vertex_lengths({}, sizing, t.points, test::connect(t)));
  return mesh;
}

RemeshOptions in_mode(ConnectivityMode mode, Effort effort = Effort::standard) {
  RemeshOptions options;
  options.connectivity = mode;
  options.effort = effort;
  return options;
}

double rms_length_error(const TriMesh& mesh) {
  const Mat3X points = vertex_points(mesh);
  const Adjacency c = make_adjacency(static_cast<int>(points.cols()), triangles_of(mesh));
  const TargetLengths targets = spread_target_lengths(c, vertex_values(mesh, target_length_property));
  double sum = 0;
  for (size_t e = 0; e < c.edges.size(); ++e) {
    const double l = (points.col(c.edges[e][1]) - points.col(c.edges[e][0])).norm();
    sum += std::pow(l / targets.edge[e] - 1, 2);
  }
  return std::sqrt(sum / static_cast<double>(c.edges.size()));
}

TEST(RemeshToSizing, EdgesFollowTargetsThatVary) {
  TriMesh fixed = graded_sphere(), flip = graded_sphere();
  EXPECT_GT(rms_length_error(fixed), .4);
  remesh(fixed, {});
  EXPECT_LT(rms_length_error(fixed), .2);
  remesh(flip, in_mode(ConnectivityMode::flip));
  EXPECT_LT(rms_length_error(flip), .12);
  for (const TriMesh* mesh : {&fixed, &flip}) {  // target lengths belong to surface positions
    const std::vector<double> lengths = vertex_values(*mesh, target_length_property);
    const auto points = vertex_points(*mesh);
    const double scale = lengths[0] / (2.5 + 1.5 * points(2, 0));
    for (size_t v = 0; v < lengths.size(); ++v)
      EXPECT_NEAR(lengths[v] / scale, 2.5 + 1.5 * points(2, static_cast<Eigen::Index>(v)), .05);
  }
}

TEST(RemeshToSizing, OneThreadAndTwoFollowThemWithTheSameBits) {
  for (const ConnectivityMode mode : {ConnectivityMode::fixed, ConnectivityMode::flip}) {
    TriMesh meshes[] = {graded_sphere(), graded_sphere()};
    for (int threads : {1, 2}) {
      const ThreadLimit limit(threads);
      remesh(meshes[threads - 1], in_mode(mode, Effort::fast));
    }
    EXPECT_EQ(vertex_points(meshes[0]), vertex_points(meshes[1]));
    EXPECT_EQ(triangles_of(meshes[0]), triangles_of(meshes[1]));
  }
}

TEST(RemeshRefit, WhereNothingHindersOneFieldAndOneIterationDo) {
  const test::Triangles t = test::sphere(3, .25, 4);
  RemeshOptions once;
  RunOptions stubborn{RemeshOptions()};
  once.refit = Refit::once;
  stubborn.guard_limited = -1;  // any vertex limited by guards is too many
  const Outcome o = remeshed(t), same = remeshed(t, once), more = remeshed(t, stubborn);
  EXPECT_EQ(o.points, same.points);
  EXPECT_EQ(o.result.reason, StopReason::stalled);
  ASSERT_EQ(o.result.iterations.size(), 2);  // relaxation, angle optimisation
  ASSERT_GT(more.result.iterations.size(), 2);
  EXPECT_LT(o.result.iterations[0].energy, 1.001 * more.result.iterations[1].energy);
}

TEST(RemeshEffort, StandardEffortIsTheDefault) {
  for (const ConnectivityMode mode : {ConnectivityMode::fixed, ConnectivityMode::flip}) {
    RemeshOptions plain;
    plain.connectivity = mode;
    EXPECT_EQ(remeshed(jittered_grid(), in_mode(mode)).points, remeshed(jittered_grid(), plain).points);
  }
}

TEST(RemeshEffort, RaisesTheLeastAngle) {
  double before = 0;
  for (const Effort effort : {Effort::fast, Effort::standard, Effort::thorough}) {
    const Outcome o = remeshed(jittered_grid(), in_mode(ConnectivityMode::fixed, effort));
    const double angle = min_angle(o.points, jittered_grid().faces);
    EXPECT_GE(angle, before);
    before = angle;
  }
}

}  // namespace hooke::options_test
