#include "hooke/remesh/paper_mode.h"

#include <gtest/gtest.h>

#include <cmath>

#include "hooke/constraints/constraints.h"
#include "hooke/core/error.h"
#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"
#include "hooke/integrator/angle_springs.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/extent.h"
#include "hooke/mesh/mesh.h"
#include "hooke/remesh/result.h"
#include "hooke/springs/target_lengths.h"
#include "support/meshes.h"

namespace hooke::paper_mode_test {

using test::Triangles;

TriMesh with_natural_length(const Triangles& t) {
  TriMesh mesh = test::to_mesh(t);
  set_vertex_values(mesh, target_length_property,
                    natural_length(total_area(t.points, t.faces), t.faces.size()));
  return mesh;
}

double edge_deviation(const TriMesh& mesh) {
  const Adjacency c = make_adjacency(static_cast<int>(mesh.n_vertices()), triangles_of(mesh));
  const TargetLengths targets = spread_target_lengths(c, vertex_values(mesh, target_length_property));
  return relative_edge_deviation(vertex_points(mesh), c.edges, targets);
}

/// To the letter: no altitude springs, vertices filtered after Algorithm 2, to a field fitted anew.
PaperOptions letter() {
  PaperOptions options;
  options.evolution.altitude = 0;
  options.filter_every = FilterEvery::outer;
  options.refit = Refit::each;
  return options;
}

PaperOptions short_run() {
  PaperOptions options;
  options.evolution.max_steps = 30;
  options.max_outer = 2;
  return options;
}

TEST(PaperMode, ImprovesAJitteredSphereAndStaysOnIt) {
  TriMesh mesh = with_natural_length(test::sphere(2, .25));
  const double before = edge_deviation(mesh);
  PaperOptions options;
  options.max_outer = 3;
  paper_remesh(mesh, options);
  EXPECT_LT(edge_deviation(mesh), .8 * before);
  EXPECT_TRUE(test::turned_faces(test::sphere(2, .25), mesh).empty());
  const auto X = vertex_points(mesh);
  for (Eigen::Index v = 0; v < X.cols(); ++v) EXPECT_NEAR(X.col(v).norm(), 1, .01);
}

TEST(PaperMode, ConvergesWhereAllEdgesAreEqual) {
  const Triangles t = test::sphere(0);
  TriMesh mesh = with_natural_length(t);
  const RemeshResult r = paper_remesh(mesh, {});
  EXPECT_EQ(r.reason, StopReason::converged);
  ASSERT_EQ(r.iterations.size(), 1u);
  EXPECT_EQ(r.iterations[0].steps, 0);
  EXPECT_LT((vertex_points(mesh) - t.points).norm(), 1e-9);
}

TEST(PaperMode, StopsAtTheOuterLimit) {
  TriMesh mesh = with_natural_length(test::sphere(2, .3));
  const RemeshResult r = paper_remesh(mesh, short_run());
  EXPECT_EQ(r.reason, StopReason::step_limit);
  ASSERT_EQ(r.iterations.size(), 2u);
  EXPECT_EQ(r.iterations[0].steps, 30);
  EXPECT_LT(r.iterations[1].energy, r.iterations[0].energy);
}

TEST(PaperMode, StallsWhenTheEnergyNoLongerFalls) {
  TriMesh mesh = with_natural_length(test::sphere(2, .3));
  PaperOptions options = short_run();
  options.evolution.max_steps = 400;
  options.outer_drop = 1;  // no iteration lowers the energy by all of it
  const RemeshResult r = paper_remesh(mesh, options);
  EXPECT_EQ(r.reason, StopReason::stalled);
  EXPECT_EQ(r.iterations.size(), 1u);
}

TEST(PaperMode, JamsWhereNoTimeStepPassesTheTestsAndSaysWhich) {
  const Triangles t = test::sphere(1, .2);
  TriMesh mesh = with_natural_length(t);
  PaperOptions options;
  options.evolution.time_step.area_bound = 10;  // larger than any face
  const RemeshResult r = paper_remesh(mesh, options);
  EXPECT_EQ(r.reason, StopReason::jammed);
  EXPECT_EQ(r.iterations.size(), 1u);
  EXPECT_TRUE(r.jam.area_bound);
  EXPECT_LT((vertex_points(mesh) - t.points).norm(), 1e-9);
}

TEST(PaperMode, IsJammedWhereStrongForcesNoLongerMoveTheMesh) {
  TriMesh mesh = with_natural_length(test::sphere(2, .3));
  PaperOptions options = short_run();
  options.evolution.max_steps = 1;  // far from rest
  options.outer_drop = 1;
  EXPECT_EQ(paper_remesh(mesh, options).reason, StopReason::jammed);
}

TEST(PaperMode, StopsWhenTheObserverSaysSo) {
  TriMesh mesh = with_natural_length(test::sphere(1, .3));
  const RemeshResult r = paper_remesh(mesh, {}, [](const Progress& p) {
    EXPECT_STREQ(p.stage, "paper");
    return p.outer < 2 || p.step < 3;
  });
  EXPECT_EQ(r.reason, StopReason::interrupted);
  ASSERT_EQ(r.iterations.size(), 2u);
  EXPECT_EQ(r.iterations[1].steps, 3);
}

TEST(PaperMode, CountsTheTestThatBoundEveryStep) {
  TriMesh mesh = with_natural_length(test::grid(8, test::paraboloid, .4));
  const RemeshResult r = paper_remesh(mesh, short_run());
  int steps = 0;
  for (const IterationRecord& i : r.iterations) steps += i.steps;
  EXPECT_LE(r.bound.none, steps);
  EXPECT_GE(r.bound.angle + r.bound.expansion + r.bound.displacement + r.bound.area_bound + r.bound.none,
            steps);
}

TEST(PaperMode, RefusesASplineBeyondTheMemoryLimit) {
  const Triangles t = test::sphere(2, .3);
  TriMesh mesh = with_natural_length(t);
  PaperOptions options;
  options.filter.memory_limit_bytes = 100000;
  EXPECT_THROW(paper_remesh(mesh, options), LimitError);
  EXPECT_EQ(vertex_points(mesh), t.points);
}

TEST(PaperMode, CountsFoldedFacesBefore) {
  Triangles t = test::grid(8, test::flat);
  t.points.col(40) = t.points.col(41) + Vec3(.1, .03, 0);  // the middle, beyond its right neighbour
  TriMesh mesh = with_natural_length(t);
  std::vector<int> inverted;
  for (size_t f = 0; f < t.faces.size(); ++f) {
    const Vec3 a = t.points.col(t.faces[f][0]);
    const Vec3 n = (Vec3(t.points.col(t.faces[f][1])) - a).cross(Vec3(t.points.col(t.faces[f][2])) - a);
    if (n.z() < 0) inverted.push_back(static_cast<int>(f));
  }
  ASSERT_FALSE(inverted.empty());
  PaperOptions options;
  options.max_outer = 0;
  const RemeshResult r = paper_remesh(mesh, options);
  EXPECT_EQ(r.folded_before, static_cast<int>(inverted.size()));
}

TEST(PaperMode, BoundaryIsFreeUnlessToldOtherwise) {
  const Triangles t = test::grid(8, test::paraboloid, .4);
  const auto on_boundary = [&](Eigen::Index v) { return v % 9 == 0 || v % 9 == 8 || v < 9 || v >= 72; };
  const auto max_move = [&](BoundaryRule rule) {
    TriMesh mesh = with_natural_length(t);
    PaperOptions options = short_run();
    options.constraints.boundary = rule;
    paper_remesh(mesh, options);
    double across = 0, any = 0;  // across the sides of the square; anywhere
    for (Eigen::Index v = 0; v < t.points.cols(); ++v) {
      if (!on_boundary(v)) continue;
      const Vec3 move = vertex_points(mesh).col(v) - t.points.col(v);
      const bool upright = v % 9 == 0 || v % 9 == 8;
      across = std::max(across, std::abs(upright ? move.x() : move.y()));
      any = std::max(any, move.norm());
    }
    return std::pair(across, any);
  };
  EXPECT_GT(max_move(BoundaryRule::free).first, 1e-5);
  EXPECT_LT(max_move(BoundaryRule::slide).first, 1e-12);
  EXPECT_GT(max_move(BoundaryRule::slide).second, 1e-5);
  EXPECT_EQ(max_move(BoundaryRule::fixed).second, 0);
}

TEST(PaperMode, DoesNotDependOnTheNumberOfThreads) {
  const auto run = [](int threads) -> Mat3X {
    const ThreadLimit limit(threads);
    TriMesh mesh = with_natural_length(test::sphere(3, .3));
    paper_remesh(mesh, short_run());
    return vertex_points(mesh);
  };
  EXPECT_EQ(run(1), run(2));
}

TEST(PaperMode, CommutesExactlyWithScalingByAPowerOfTwo) {
  Triangles t = test::grid(8, test::paraboloid, .4);
  TriMesh mesh = with_natural_length(t);
  t.points *= 1024;
  TriMesh large = with_natural_length(t);
  PaperOptions options = short_run();
  options.filter.offset = .02;
  options.filter.offset_unit = OffsetUnit::edge;
  paper_remesh(mesh, options);
  paper_remesh(large, options);
  EXPECT_EQ(vertex_points(large), 1024 * vertex_points(mesh));
}

double min_angle_of(const TriMesh& mesh) {
  return min_angle(vertex_points(mesh), triangles_of(mesh));
}

TEST(PaperMode, AltitudeSpringsKeepFacesFromCollapsing) {
  double worst = 60, worst_without = 60;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    TriMesh mesh = with_natural_length(test::sphere(2, .4, seed)), without = mesh;
    PaperOptions options;
    paper_remesh(mesh, options);
    EXPECT_TRUE(test::turned_faces(test::sphere(2, .4, seed), mesh).empty()) << seed;
    options.evolution.altitude = 0;
    paper_remesh(without, options);
    worst = std::min(worst, min_angle_of(mesh));
    worst_without = std::min(worst_without, min_angle_of(without));
  }
  EXPECT_GT(worst, 50);
  EXPECT_LT(worst_without, 10);
}

TEST(PaperMode, EachTimeStepEndsOnTheSurfaceOfTheInput) {
  const Triangles t = test::sphere(2, .3);
  TriMesh mesh = with_natural_length(t);
  PaperOptions options = short_run();
  options.max_outer = 1;
  const auto X = vertex_points(mesh);
  double off = 0;
  const RemeshResult r = paper_remesh(mesh, options);
  for (Eigen::Index v = 0; v < X.cols(); ++v) off = std::max(off, std::abs(X.col(v).norm() - 1));
  EXPECT_LT(off, .01);
  // A vertex is evaluated about once in a few steps, and not once more for a fit.
  EXPECT_LE(r.projection.evaluations, 2 * (r.iterations[0].steps + 2) * X.cols());
}

TEST(PaperMode, RecordsEachTimeStep) {
  TriMesh mesh = with_natural_length(test::sphere(2, .3));
  const RemeshResult r = paper_remesh(mesh, short_run());
  ASSERT_EQ(r.time_steps.size(), 60u);
  int cut = 0;
  for (std::size_t k = 0; k < r.time_steps.size(); ++k) {
    const TimeStepRecord& s = r.time_steps[k];
    EXPECT_EQ(s.outer, 1 + static_cast<int>(k) / 30);
    EXPECT_EQ(s.step, 1 + static_cast<int>(k) % 30);
    EXPECT_GT(s.step_time, 0);
    EXPECT_GT(s.string_energy, 0);
    EXPECT_GT(s.altitude_energy, 0);
    EXPECT_GT(s.kinetic_energy, 0);
    EXPECT_GT(s.max_force, 0);
    cut += s.bound.any();
  }
  const Mat3X velocities =
      as_matrix(mesh, OpenMesh::getProperty<OpenMesh::VertexHandle, Vec3>(mesh, velocity_property));
  EXPECT_NEAR(velocities.squaredNorm() / (2 * velocities.cols()), r.time_steps.back().kinetic_energy,
              1e-9 * r.time_steps.back().kinetic_energy);
  EXPECT_EQ(cut, 60 - r.bound.none);
  EXPECT_LT(r.time_steps.back().string_energy, r.time_steps.front().string_energy);
}

/// The greatest distance of a vertex from the unit sphere.
double distance_from_sphere(const TriMesh& mesh) {
  double distance = 0;
  const auto X = vertex_points(mesh);
  for (Eigen::Index v = 0; v < X.cols(); ++v) distance = std::max(distance, std::abs(X.col(v).norm() - 1));
  return distance;
}

TEST(PaperMode, AFieldFittedToMovedVerticesForgetsTheSurface) {
  double once = 0, each = 0;
  for (unsigned seed = 1; seed <= 3; ++seed) {
    TriMesh mesh = with_natural_length(test::sphere(2, .4, seed)), refitted = mesh;
    PaperOptions options;
    options.max_outer = 8;
    options.outer_drop = -1;
    paper_remesh(mesh, options);
    options.refit = Refit::each;
    paper_remesh(refitted, options);
    once += distance_from_sphere(mesh);
    each += distance_from_sphere(refitted);
  }
  EXPECT_GT(each, 1.5 * once);
}

TEST(PaperMode, FilteredAfterAlgorithm2OnlyVerticesLeaveTheSurface) {
  // The distance before the last filtering shows as the way of the vertices in it: run without any filter.
  TriMesh filtered = with_natural_length(test::sphere(2, .4)), unfiltered = filtered;
  PaperOptions options = short_run();
  options.max_outer = 1;
  options.evolution.max_steps = 400;
  paper_remesh(filtered, options);
  options.filter_every = FilterEvery::outer;
  options.filter.kind = FilterKind::none;  // not even at the end
  paper_remesh(unfiltered, options);
  EXPECT_GT(distance_from_sphere(unfiltered), 3 * distance_from_sphere(filtered));
}

TEST(PaperMode, TorquesOutweighStringsWhereTheMeshIsNotScaled) {
  // In file units a string force shrinks with the mesh and a torque does not; scaled, both results agree.
  const Triangles t = test::sphere(2, .3);
  TriMesh mesh = with_natural_length(t), small = with_natural_length({t.points / 64, t.faces});
  PaperOptions options = short_run();
  options.filter.offset_unit = OffsetUnit::edge;
  paper_remesh(mesh, options);
  TriMesh unscaled = with_natural_length(t);
  paper_remesh(small, options);
  EXPECT_LT((64 * vertex_points(small) - vertex_points(mesh)).norm(), 1e-9);
  options.evolution.damped.torque *= 64;  // what a mesh a 64th of the size would see
  paper_remesh(unscaled, options);
  EXPECT_GT((vertex_points(unscaled) - vertex_points(mesh)).norm(), .01);
}

TEST(PaperMode, AnAbsoluteOffsetDoesNotGrowWithTheMesh) {
  // The field of a mesh 1000 times as large with an offset of 1e-3 is that of the mesh with 1e-6.
  Triangles t = test::sphere(2, .3);
  TriMesh mesh = with_natural_length(t);
  t.points *= 1024;
  TriMesh large = with_natural_length(t);
  PaperOptions small_offset = short_run(), absolute = short_run();
  small_offset.filter.offset = 1e-3;
  absolute.filter.offset = 1.024;
  paper_remesh(mesh, small_offset);
  paper_remesh(large, absolute);
  EXPECT_EQ(vertex_points(large), 1024 * vertex_points(mesh));
}

}  // namespace hooke::paper_mode_test
