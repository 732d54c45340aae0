#include "hooke/integrator/lbfgs.h"

#include <gtest/gtest.h>

#include "hooke/constraints/constraints.h"
#include "hooke/core/parallel.h"
#include "hooke/filter/retraction.h"
#include "hooke/integrator/relaxation.h"
#include "support/scene.h"

namespace hooke::lbfgs_test {

IntegrationOptions until_rest() {
  IntegrationOptions options;
  options.energy_drop = 1e-9;
  return options;
}

IntegrationResult relax(test::Scene& s, const IntegrationOptions& options = until_rest(),
                        const Observer& observer = nullptr) {
  Relaxation r = s.relaxation();
  return relax_lbfgs(r, options, LbfgsOptions{}, observer);
}

/// Guarded steps along the gradient; returns the minimum energy.
double descend(test::Scene& s, int steps) {
  double energy = s.energy(s.positions.points, s.positions.normals, nullptr);
  double step = .1 * s.L() * s.L();
  for (int i = 0; i < steps; ++i) {
    Mat3X u = -step * s.tangent_gradient();
    cap_displacement(s.length, .3, u);
    SurfacePositions to;
    s.guards.step(s.retraction, s.positions, u, to);
    const double now = s.energy(to.points, to.normals, nullptr);
    step *= now < energy ? 1.1 : .5;
    if (now >= energy) continue;
    energy = now;
    s.positions = to;
  }
  return energy;
}

TEST(RelaxLbfgs, GetsLowerThanGradientSteps) {
  for (double jitter : {.2, .4}) {
    test::Scene by_lbfgs = test::ground_scene(jitter), by_gradient = test::ground_scene(jitter);
    EXPECT_LT(relax(by_lbfgs).energy, descend(by_gradient, 200));
  }
}

TEST(RelaxLbfgs, ComesToRestWhereTheGradientIsSmall) {
  for (bool on_sphere : {true, false}) {
    test::Scene s = on_sphere ? test::sphere_scene(.35) : test::ground_scene(.4);
    ASSERT_TRUE(s.guards.folded_faces(s.positions).empty());  // folds would limit the steps
    const double start = s.tangent_gradient().norm();
    const double energy = s.energy(s.positions.points, s.positions.normals, nullptr);
    const IntegrationResult result = relax(s);
    EXPECT_EQ(result.reason, StopReason::stalled);
    EXPECT_LT(s.tangent_gradient().norm(), 1e-3 * start);
    EXPECT_LT(result.energy, .5 * energy);
    EXPECT_NEAR(s.energy(s.positions.points, s.positions.normals, nullptr), result.energy,
                1e-12 * result.energy);
  }
}

TEST(RelaxLbfgs, KeepsEveryVertexOnTheSurfaceAndNoFaceFolds) {
  for (double lazy : {0., .01}) {
    test::SceneOptions options;
    options.retraction.lazy = lazy;
    test::Scene s = test::sphere_scene(.35, options);
    ASSERT_TRUE(s.guards.folded_faces(s.positions).empty());  // what is folded at the start may stay so
    relax(s);
    EXPECT_LT((s.positions.points.colwise().norm().array() - 1).abs().maxCoeff(), 1e-15);
    for (const Triangle& t : s.adjacency.faces)
      EXPECT_GT(test::area_vector(s.positions.points, t).dot(s.positions.points.col(t[0])), 0);
  }
}

TEST(RelaxLbfgs, LeavesDriftOnlyIfItDoesNotProjectAtTheEnd) {
  test::SceneOptions options;
  options.retraction.lazy = .01;
  const auto drift = [&](bool projects_at_end) {
    test::Scene s = test::sphere_scene(.35, options);
    Relaxation r = s.relaxation();
    LbfgsOptions lbfgs;
    lbfgs.projects_at_end = projects_at_end;
    relax_lbfgs(r, until_rest(), lbfgs, nullptr);
    return (s.positions.points.colwise().norm().array() - 1).abs().maxCoeff();
  };
  EXPECT_LT(drift(true), 1e-15);
  EXPECT_GT(drift(false), 1e-12);
  EXPECT_LT(drift(false), options.retraction.lazy);
}

TEST(RelaxLbfgs, HasOnlySweepsWhereOneEvaluationIsAllowed) {
  IntegrationOptions once;
  once.max_steps = 1;
  test::Scene s = test::ground_scene(.4);
  const double before = s.energy(s.positions.points, s.positions.normals, nullptr);
  const IntegrationResult result = relax(s, once);
  EXPECT_EQ(result.steps, 0);
  EXPECT_EQ(result.evaluations, 1);
  EXPECT_LT(result.energy, before);
  EXPECT_EQ(result.reason, StopReason::step_limit);
}

TEST(RelaxLbfgs, KeepsCornersAndCurves) {
  test::Triangles t = test::moved(test::grid(8, test::flat, .4));
  const Vec3 normal = test::area_vector(t.points, t.faces[0]).normalized();
  const Vec3 origin = t.points.col(0);
  const auto plane = [&](const Vec3& x, int hint, double) {
    return Projection{x - normal * normal.dot(x - origin), normal, hint, ProjectionStatus::converged, 1};
  };
  test::Scene s(t, plane);
  relax(s);
  for (size_t v = 0; v < s.length.size(); ++v) {
    const Vec3 x = s.positions.points.col(static_cast<Eigen::Index>(v));
    if (s.constraints.freedom[v] == Freedom::fixed) {
      EXPECT_EQ(x, t.points.col(static_cast<Eigen::Index>(v)));
    }
    if (s.constraints.freedom[v] == Freedom::curve) {
      EXPECT_LT(test::distance_to(s.constraints.curves[s.constraints.curve[v]], x), 1e-13);
    }
  }
}

TEST(RelaxLbfgs, TheEnergyFallsFromStepToStep) {
  test::Scene s = test::sphere_scene(.4);
  std::vector<double> energies;
  const IntegrationResult result = relax(s, until_rest(), [&](const Progress& p) {
    if (!energies.empty() && p.step == static_cast<int>(energies.size())) {  // another try at the next step
      EXPECT_EQ(p.energy, energies.back());
      return true;
    }
    if (p.step == 0) return true;
    EXPECT_EQ(p.step, static_cast<int>(energies.size()) + 1);
    energies.push_back(p.energy);
    return true;
  });
  ASSERT_GT(energies.size(), 3u);
  EXPECT_TRUE(std::ranges::is_sorted(energies, std::greater<>{}));
  EXPECT_EQ(static_cast<int>(energies.size()), result.steps);
  EXPECT_EQ(energies.back(), result.energy);
  EXPECT_GT(result.evaluations, result.steps);
}

/// A grid that is dense on one side, whose vertices have to travel far past fixed ones.
TEST(RelaxLbfgs, LongWavesDoNotBreakOnVerticesThatStand) {
  const int n = 60;
  test::Triangles t = test::grid(n, test::flat, .2, 3);
  for (auto p : t.points.colwise()) p[0] = p[0] * (.4 + .6 * p[0]);
  const auto relaxed = [&](double max_capped_fraction) {
    test::SceneOptions options;
    for (int i = 1; i < 6; ++i)
      for (int j = 1; j < 6; ++j) options.constraints.fixed_vertices.push_back(10 * i * (n + 1) + 10 * j);
    test::Scene s(t, test::to_ground, options);
    Relaxation r = s.relaxation();
    IntegrationOptions integration = until_rest();
    integration.max_steps = 60;
    LbfgsOptions lbfgs;
    lbfgs.max_capped_fraction = max_capped_fraction;
    return relax_lbfgs(r, integration, lbfgs, nullptr);
  };
  const IntegrationResult breaking = relaxed(2), whole = relaxed(LbfgsOptions{}.max_capped_fraction);
  EXPECT_LT(whole.energy, .9 * breaking.energy);
  EXPECT_LT(whole.limited_steps, breaking.limited_steps);
}

TEST(RelaxLbfgs, SaysWhyItStops) {
  test::Scene stopped = test::sphere_scene(.4), limited = test::sphere_scene(.4);
  const IntegrationResult interrupted =
      relax(stopped, until_rest(), [](const Progress& p) { return p.step < 2; });
  EXPECT_EQ(interrupted.reason, StopReason::interrupted);
  EXPECT_EQ(interrupted.steps, 2);

  IntegrationOptions few = until_rest();
  few.max_steps = 4;
  const IntegrationResult result = relax(limited, few);
  EXPECT_EQ(result.reason, StopReason::step_limit);
  EXPECT_LE(result.evaluations, 4);
}

TEST(RelaxLbfgs, WhatIsAtRestHardlyMoves) {
  test::Scene s = test::sphere_scene(.3);
  relax(s);
  const Mat3X rest = s.positions.points;
  relax(s);
  EXPECT_LT((s.positions.points - rest).colwise().norm().maxCoeff(), 1e-2 * s.L());
}

TEST(RelaxLbfgs, OneThreadAndTwoGiveTheSameBits) {
  std::vector<SurfacePositions> results;
  for (int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    test::Scene s(test::grid(70, test::flat, .35), test::to_ground);  // more than one block in every loop
    relax(s, IntegrationOptions{});
    results.push_back(s.positions);
  }
  EXPECT_TRUE(test::same(results[0], results[1]));
}

}  // namespace hooke::lbfgs_test
