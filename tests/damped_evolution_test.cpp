#include "hooke/integrator/damped_evolution.h"

#include <gtest/gtest.h>

#include <cmath>

#include "hooke/core/error.h"
#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"
#include "hooke/springs/hooke_law.h"
#include "meshes.h"

namespace hooke {
namespace {

using test::Triangles;

/// A mesh with its connectivity, scaled so that the target length 1 is its mean edge length.
struct Body {
  TriMesh mesh;
  Connectivity connectivity;
  std::vector<double> lengths;
};

Body body(Triangles t) {
  Connectivity c = make_connectivity(static_cast<int>(t.points.cols()), t.faces);
  double sum = 0;
  for (const auto& [i, j] : c.edges) sum += (t.points.col(j) - t.points.col(i)).norm();
  t.points *= double(c.edges.size()) / sum;
  std::vector<double> lengths(c.edges.size(), 1.);
  return {test::to_mesh(t), std::move(c), std::move(lengths)};
}

double string_energy(const Body& b) {
  const auto X = positions(b.mesh);
  double sum = 0;
  for (size_t e = 0; e < b.lengths.size(); ++e) {
    const auto [i, j] = b.connectivity.edges[e];
    sum += spring_potential((X.col(j) - X.col(i)).norm(), b.lengths[e]).value;
  }
  return sum;
}

TEST(DampedEvolution, VelocityDecaysExactlyWithoutForce) {
  Body b = body(test::sphere(1));
  Motion motion = motion_of(b.mesh);
  come_to_rest(motion);
  motion.velocities.colwise() = Vec3(1, 2, 3);
  const Mat3X start = motion.points;
  const EvolutionOptions free{.damped = {.string = 0, .torque = 0}};
  const EvolutionStep step = evolution_step(motion, b.connectivity, b.lengths, free, nullptr, first_factor);
  const double decay = std::exp(-free.damped.friction * step.adapted.time);
  ASSERT_GT(step.adapted.time, 0);
  for (Eigen::Index v = 0; v < start.cols(); ++v) {
    EXPECT_TRUE(motion.velocities.col(v).isApprox(decay * Vec3(1, 2, 3), 1e-14));
    const Vec3 way = motion.points.col(v) - start.col(v);
    EXPECT_TRUE(way.isApprox((1 - decay) / free.damped.friction * Vec3(1, 2, 3), 1e-9));
  }
}

TEST(DampedEvolution, StartsFromRest) {
  Body fresh = body(test::sphere(1, .2)), stale = fresh;
  Motion motion = motion_of(stale.mesh);
  motion.velocities.setConstant(9);
  motion.forces.setConstant(9);
  const EvolutionOptions options{.tolerance = 0, .max_steps = 20};
  evolve_damped(fresh.mesh, fresh.connectivity, fresh.lengths, options);
  evolve_damped(stale.mesh, stale.connectivity, stale.lengths, options);
  EXPECT_EQ(positions(fresh.mesh), positions(stale.mesh));
}

TEST(DampedEvolution, OneTriangleRelaxesToItsRestLength) {
  Triangles t{Mat3X(3, 3), {{0, 1, 2}}};
  t.points << 0, 1.2, .3, 0, 0, .5, 0, 0, .1;
  Body b = body(t);
  const EvolutionResult r =
      evolve_damped(b.mesh, b.connectivity, b.lengths, {.tolerance = .02, .max_steps = 4000});
  EXPECT_EQ(r.reason, StopReason::converged);
  EXPECT_LT(r.max_length_error, .02);
  EXPECT_GT(face_shape(positions(b.mesh), {0, 1, 2}).area, .41);  // sqrt(3) / 4 = .433
}

TEST(DampedEvolution, LosesEnergyByFriction) {
  Body b = body(test::sphere(2, .3));
  const EvolutionOptions options{.damped = {.torque = 0}, .tolerance = 0, .max_steps = 300};
  Motion motion = motion_of(b.mesh);
  const auto total = [&] {
    return options.damped.string * string_energy(b) + .5 * motion.mass * motion.velocities.squaredNorm();
  };
  come_to_rest(motion);
  const double start = total();
  double last = start;
  evolve_damped(b.mesh, b.connectivity, b.lengths, options, nullptr, [&](const Progress& step) {
    // The first step starts from rest: friction has nothing to take yet, and [22] keeps the energy to first
    // order in dt.
    EXPECT_LT(total(), step.step == 1 ? 1.001 * last : last) << "step " << step.step;
    last = total();
    return true;
  });
  EXPECT_LT(last, .1 * start);
}

TEST(DampedEvolution, EveryAcceptedStepPassesTheFourTests) {
  Body b = body(test::grid(8, test::paraboloid, .4));
  Mat3X before = positions(b.mesh);
  const EvolutionOptions options{.tolerance = 0, .max_steps = 100};
  const auto check = [&](const Progress&) {
    const Mat3X after = positions(b.mesh);
    double shortest = 1e9;
    for (const auto& [i, j] : b.connectivity.edges)
      shortest = std::min(shortest, (before.col(j) - before.col(i)).norm());
    EXPECT_LT((after - before).colwise().norm().maxCoeff(), .01 * shortest);
    for (const Triangle& f : b.connectivity.faces) {
      const FaceShape was = face_shape(before, f), is = face_shape(after, f);
      EXPECT_GT(was.normal.dot(is.normal), .9);
      EXPECT_GT(is.area, 0);
      EXPECT_NEAR(is.area / was.area, 1, .01);
    }
    before = after;
    return true;
  };
  const EvolutionResult r = evolve_damped(b.mesh, b.connectivity, b.lengths, options, nullptr, check);
  EXPECT_EQ(r.reason, StopReason::step_limit);
  EXPECT_EQ(r.steps, 100);
  EXPECT_GE(r.bound.angle + r.bound.expansion + r.bound.displacement + r.bound.area_bound + r.bound.none,
            100);
}

TEST(DampedEvolution, ReportsAJamAndLeavesTheMeshAlone) {
  Body b = body(test::sphere(1, .2));
  const Mat3X before = positions(b.mesh);
  EvolutionOptions options;
  options.time_step.area_bound = 10;  // larger than any face
  const EvolutionResult r = evolve_damped(b.mesh, b.connectivity, b.lengths, options);
  EXPECT_EQ(r.reason, StopReason::jammed);
  EXPECT_EQ(r.steps, 0);
  EXPECT_GT(r.evaluations, 0);
  EXPECT_TRUE(r.jam.area_bound);
  EXPECT_EQ(positions(b.mesh), before);
}

TEST(DampedEvolution, WalksOnWithAZeroAreaFaceInTheInput) {
  Triangles t = test::grid(4, test::flat);
  t.points.col(1) = .5 * (t.points.col(0) + t.points.col(6));  // face 0 1 6 has no area
  Body b = body(t);
  const auto degenerate = [&] { return face_shape(positions(b.mesh), b.connectivity.faces[0]).degenerate(); };
  ASSERT_TRUE(degenerate());
  const EvolutionResult r =
      evolve_damped(b.mesh, b.connectivity, b.lengths, {.tolerance = 0, .max_steps = 20});
  EXPECT_EQ(r.steps, 20);
  EXPECT_FALSE(degenerate());
}

TEST(DampedEvolution, IsAtRestWithoutForces) {
  Body b = body(test::sphere(1, .2));
  const Restraint nothing_pulls = [](Mat3X& forces) { forces.setZero(); };
  const EvolutionResult r = evolve_damped(b.mesh, b.connectivity, b.lengths, {.tolerance = 0}, nothing_pulls);
  EXPECT_EQ(r.reason, StopReason::stalled);
  EXPECT_EQ(r.steps, 0);
}

TEST(DampedEvolution, LeavesAFinishedMeshAlone) {
  Body b = body(test::sphere(0));  // all edges are equal
  const Mat3X before = positions(b.mesh);
  const EvolutionResult r = evolve_damped(b.mesh, b.connectivity, b.lengths, {});
  EXPECT_EQ(r.reason, StopReason::converged);
  EXPECT_EQ(r.steps, 0);
  EXPECT_EQ(positions(b.mesh), before);
}

TEST(DampedEvolution, StopsWhenTheObserverSaysSo) {
  Body b = body(test::sphere(1, .2));
  const EvolutionResult r = evolve_damped(b.mesh, b.connectivity, b.lengths, {.tolerance = 0}, nullptr,
                                          [](const Progress& step) { return step.step < 3; });
  EXPECT_EQ(r.reason, StopReason::interrupted);
  EXPECT_EQ(r.steps, 3);
}

TEST(DampedEvolution, RefusesConstantsThatAreNotPositive) {
  Body b = body(test::sphere(1, .2));
  EXPECT_THROW(evolve_damped(b.mesh, b.connectivity, b.lengths, {.damped = {.friction = 0}}), Error);
  EXPECT_THROW(evolve_damped(b.mesh, b.connectivity, b.lengths, {.damped = {.string = 0}}), Error);
}

TEST(DampedEvolution, DoesNotDependOnTheNumberOfThreads) {
  const auto run = [](int threads) -> Mat3X {
    const ThreadLimit limit(threads);
    Body b = body(test::sphere(4, .2));
    evolve_damped(b.mesh, b.connectivity, b.lengths, {.tolerance = 0, .max_steps = 20});
    return positions(b.mesh);
  };
  EXPECT_EQ(run(1), run(2));
}

}  // namespace
}  // namespace hooke
