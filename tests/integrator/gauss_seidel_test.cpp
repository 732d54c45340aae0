#include "hooke/integrator/gauss_seidel.h"

#include <gtest/gtest.h>

#include "hooke/constraints/constraints.h"
#include "hooke/core/parallel.h"
#include "hooke/filter/retraction.h"
#include "hooke/integrator/relaxation.h"
#include "hooke/integrator/vertex_ring.h"
#include "support/scene.h"

namespace hooke::gauss_seidel_test {

double energy_around(test::Scene& s, int vertex) {
  VertexRing ring(s.coloring.rings, s.targets);
  RingShape shape;
  ring.gather(s.positions, vertex);
  ring.shape(s.positions.points.col(vertex), s.positions.normals.col(vertex), shape);
  return ring.energy(shape, s.terms);
}

std::vector<char> only(const test::Scene& s, int vertex) {
  std::vector<char> active(s.length.size(), 0);
  active[vertex] = 1;
  return active;
}

TEST(LocalNewton, NeverRaisesTheEnergyAroundAVertex) {
  test::Scene sphere = test::sphere_scene(.4), ground = test::ground_scene(.4);
  for (test::Scene* s : {&sphere, &ground}) {
    const Relaxation r = s->relaxation();
    Relaxation moving = r;
    int fell = 0;
    for (int v = 0; v < s->adjacency.vertex_count; ++v) {
      const double before = energy_around(*s, v);
      const Mat3X points = s->positions.points;
      local_newton_sweep(moving, only(*s, v), {.over_relaxation = 1.5});
      EXPECT_LE(energy_around(*s, v), before);
      fell += energy_around(*s, v) < before;
      for (int w = 0; w < s->adjacency.vertex_count; ++w)
        if (w != v) {
          EXPECT_EQ(s->positions.points.col(w), points.col(w));
        }
    }
    EXPECT_GT(fell, s->adjacency.vertex_count / 2);
  }
}

TEST(LocalNewton, SweepsLowerTheEnergyOfAllAndKeepTheGuards) {
  for (double factor : {1., 1.5}) {
    test::Scene s = test::sphere_scene(.25);
    ASSERT_TRUE(s.guards.folded_faces(s.positions).empty());
    const double start = s.energy(s.positions.points, s.positions.normals, nullptr);
    double energy = start;
    for (int sweep = 0; sweep < 5; ++sweep) {
      Relaxation r = s.relaxation();
      local_newton_sweep(r, {}, {.over_relaxation = factor});
      const double now = s.energy(s.positions.points, s.positions.normals, nullptr);
      EXPECT_LT(now, energy);
      energy = now;
      EXPECT_TRUE(s.guards.folded_faces(s.positions).empty());
    }
    EXPECT_LT(energy, .5 * start);
    EXPECT_LT((s.positions.points.colwise().norm().array() - 1).abs().maxCoeff(), 1e-15);
  }
}

TEST(LocalNewton, WithoutMiddleStepsItTakesTheLongestOrTheShortest) {
  test::Scene s = test::sphere_scene(.4);
  Relaxation r = s.relaxation();
  LocalNewton newton(r);
  const SurfacePositions start = s.positions;
  int shorter = 0;
  for (int v = 0; v < s.adjacency.vertex_count; ++v) {
    const auto move = [&](bool skips_middle_steps) {
      s.positions = start;
      const double distance =
          newton.improve(v, {.max_move = 9, .over_relaxation = 9, .skips_middle_steps = skips_middle_steps});
      EXPECT_EQ(newton.was_refused(), distance == 0);  // no vertex is at rest
      return distance;
    };
    const double distance = move(false), without = move(true);
    EXPECT_TRUE(without == distance || without < .6 * distance) << distance << " " << without;
    shorter += without < distance;
  }
  EXPECT_GT(shorter, 9);
}

TEST(LocalNewton, FindsTheMinimumAroundAVertexInAFewSteps) {
  test::Scene sphere = test::sphere_scene(.2), ground = test::ground_scene(.2);
  const std::pair<test::Scene*, int> cases[] = {{&sphere, 50}, {&ground, 30}, {&ground, 3}};  // 3 slides
  for (const auto& [s, vertex] : cases) {
    const double start = s->tangent_gradient().col(vertex).norm();
    ASSERT_GT(start, 1e-3);
    for (int step = 0; step < 8; ++step) {
      Relaxation r = s->relaxation();
      local_newton_sweep(r, only(*s, vertex), {});
    }
    EXPECT_LT(s->tangent_gradient().col(vertex).norm(), 1e-3 * start) << vertex;
  }
}

TEST(LocalNewton, ReportsTheLargestMoveAndKeepsToTheCap) {
  test::Scene s = test::sphere_scene(.4);
  const Mat3X start = s.positions.points;
  Relaxation r = s.relaxation();
  const double move = std::ranges::max(local_newton_sweep(r, {}, {.max_move = .05}));
  EXPECT_NEAR(move, (s.positions.points - start).colwise().norm().maxCoeff() / s.L(), 1e-12);
  EXPECT_LE(move, .05);
  EXPECT_GT(move, .04);
}

TEST(LocalNewton, WhatStandsStillStandsStill) {
  test::Triangles t = test::grid(8, test::flat, .3);
  t.points.conservativeResize(3, t.points.cols() + 2);  // vertices without faces
  t.points.rightCols(2).setConstant(.4);
  test::Scene s(t, test::to_ground);
  Relaxation r = s.relaxation();
  const Mat3X start = s.positions.points;
  local_newton_sweep(r, {}, {});
  for (size_t v = 0; v < s.length.size(); ++v) {
    const auto i = static_cast<Eigen::Index>(v);
    if (s.constraints.freedom[v] == Freedom::fixed) {
      EXPECT_EQ(s.positions.points.col(i), start.col(i)) << v;
    }
  }
  EXPECT_NE(s.positions.points, start);
}

TEST(LocalNewton, CurvatureIsThatOfTheTangentSpaceAndAlwaysDescends) {
  test::Scene sphere = test::sphere_scene(.4), ground = test::ground_scene(.4);
  for (test::Scene* s : {&sphere, &ground}) {
    Relaxation r = s->relaxation();
    LocalNewton newton(r);
    const Mat3X gradient = s->tangent_gradient();
    const SurfacePositions before = s->positions;
    for (int v = 0; v < s->adjacency.vertex_count; ++v) {
      const LocalCurvature c = newton.curvature(v);
      const double size = c.inverse.norm();
      EXPECT_LE((c.inverse - c.inverse.transpose()).norm(), 1e-14 * size);
      EXPECT_LE((c.inverse * s->positions.normals.col(v)).norm(), 1e-12 * size);
      EXPECT_GE(gradient.col(v).dot(c.inverse * gradient.col(v)), 0);
      EXPECT_EQ(c.mean > 0, s->constraints.freedom[v] != Freedom::fixed);
      const Vec3 tangent = s->retraction.tangent(s->positions, v);
      if (!tangent.isZero()) {
        EXPECT_LT((c.inverse - size * tangent * tangent.transpose()).norm(), 1e-12 * size);
      }
    }
    EXPECT_TRUE(test::same(s->positions, before));
  }
}

TEST(LocalNewton, WhatIsAtRestStays) {
  test::Scene s = test::sphere_scene(.4);
  const SurfacePositions before = s.positions;
  Relaxation r = s.relaxation();
  local_newton_sweep(r, {}, {.rest = 10});
  EXPECT_TRUE(test::same(s.positions, before));
}

TEST(LocalNewton, AVertexWithoutFacesHasNoCurvature) {
  test::Triangles t = test::sphere(1);
  t.points.conservativeResize(3, t.points.cols() + 1);
  t.points.rightCols(1) = Vec3::UnitX();
  test::Scene s(t, test::to_unit_sphere);
  Relaxation r = s.relaxation();
  const LocalCurvature c = LocalNewton(r).curvature(s.adjacency.vertex_count - 1);
  EXPECT_EQ(c.mean, 0);
  EXPECT_TRUE(c.inverse.isZero(0));
}

TEST(LocalNewton, OneThreadAndTwoGiveTheSameBits) {
  std::vector<SurfacePositions> results;
  for (int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    test::Scene s(test::sphere(3, .35), test::to_unit_sphere);
    for (int sweep = 0; sweep < 3; ++sweep) {
      Relaxation r = s.relaxation();
      local_newton_sweep(r, {}, {.over_relaxation = 1.5});
    }
    results.push_back(s.positions);
  }
  EXPECT_TRUE(test::same(results[0], results[1]));
}

}  // namespace hooke::gauss_seidel_test
