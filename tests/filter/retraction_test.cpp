#include "hooke/filter/retraction.h"

#include <gtest/gtest.h>

#include <atomic>

#include "hooke/constraints/constraints.h"
#include "hooke/constraints/feature_curves.h"
#include "hooke/core/parallel.h"
#include "support/scene.h"

namespace hooke::retraction_test {

TEST(Retraction, PlacesEveryVertexOnTheSurface) {
  test::Triangles t = test::sphere(2, .2);
  t.points *= 1.1;
  const test::Scene s(t, test::to_unit_sphere);
  EXPECT_LT((s.positions.points.colwise().norm().array() - 1).abs().maxCoeff(), 1e-15);
  EXPECT_LT((s.positions.normals - s.positions.points).norm(), 1e-14);
  for (int v = 0; v < t.points.cols(); ++v) EXPECT_EQ(s.retraction.tangent(s.positions, v), Vec3::Zero());
}

TEST(Retraction, AStepOfZeroChangesNothing) {
  for (double lazy : {0., .1}) {
    test::SceneOptions options;
    options.retraction.lazy = lazy;
    test::Scene s = test::ground_scene(.3, options);
    SurfacePositions to;
    s.retraction.step(s.positions, Mat3X::Zero(3, s.positions.points.cols()), to);
    EXPECT_TRUE(test::same(to, s.positions));
  }
}

TEST(Retraction, LeavesTheSurfaceBySecondOrderOnly) {
  test::Scene s = test::sphere_scene();
  Mat3X u = test::random_vectors(s.positions.points.cols(), .05);
  s.retraction.constrain(s.positions, u);
  SurfacePositions to;
  s.retraction.step(s.positions, u, to);
  EXPECT_LT((to.points.colwise().norm().array() - 1).abs().maxCoeff(), 1e-15);
  const Mat3X off = to.points - s.positions.points - u;
  for (Eigen::Index v = 0; v < u.cols(); ++v) EXPECT_LE(off.col(v).norm(), u.col(v).squaredNorm());
}

TEST(Retraction, TouchesOnlyTheGivenVertices) {
  test::Scene s = test::ground_scene();
  const Mat3X u = test::random_vectors(s.positions.points.cols(), .02);
  SurfacePositions to = s.positions, all;
  s.retraction.step(s.positions, u, all);
  const std::vector<int> some = {0, 11, 40, 41};  // a corner, an inner one ...
  s.retraction.step(s.positions, u, some, to);
  for (int v = 0; v < s.adjacency.vertex_count; ++v)
    EXPECT_EQ(to.points.col(v), (std::ranges::count(some, v) ? all : s.positions).points.col(v)) << v;
}

TEST(Retraction, AVertexThatSlidesStaysOnThePolylineOfTheInput) {
  const auto wave = [](double x, double y) { return .1 * std::sin(5 * x) * std::sin(4 * y + 1); };
  const test::Triangles t = test::moved(test::grid(10, wave));
  const auto anywhere = [](const Vec3& x, int hint, double) {
    return Projection{x, Vec3::UnitZ(), hint, ProjectionStatus::converged, 1};
  };
  test::Scene s(t, anywhere);
  SurfacePositions to;
  double moved = 0;
  for (unsigned i = 0; i < 20; ++i) {
    s.retraction.step(s.positions, test::random_vectors(t.points.cols(), .05, i), to);
    std::swap(s.positions, to);
  }
  for (size_t v = 0; v < s.length.size(); ++v) {
    const auto i = static_cast<Eigen::Index>(v);
    if (s.constraints.freedom[v] == Freedom::fixed) {
      EXPECT_EQ(s.positions.points.col(i), t.points.col(i));
    }
    if (s.constraints.freedom[v] != Freedom::curve) continue;
    const Curve& curve = s.constraints.curves[s.constraints.curve[v]];
    EXPECT_LT(test::distance_to(curve, s.positions.points.col(i)), 1e-14);
    EXPECT_NEAR(s.retraction.tangent(s.positions, static_cast<int>(v)).norm(), 1, 1e-14);
    moved = std::max(moved, (s.positions.points.col(i) - t.points.col(i)).norm());
  }
  EXPECT_GT(moved, .1);  // past the next vertex
}

TEST(Retraction, ConstrainLeavesWhatAVertexMayDo) {
  test::Scene sphere = test::sphere_scene(), ground = test::ground_scene();
  for (test::Scene* s : {&sphere, &ground}) {
    const Mat3X u = test::random_vectors(s->positions.points.cols(), 1);
    Mat3X w = u;
    s->retraction.constrain(s->positions, w);
    for (size_t v = 0; v < s->length.size(); ++v) {
      const auto i = static_cast<Eigen::Index>(v);
      const Vec3 n = s->positions.normals.col(i),
                 t = s->retraction.tangent(s->positions, static_cast<int>(v)), removed = u.col(i) - w.col(i);
      switch (s->constraints.freedom[v]) {
        case Freedom::surface:
          EXPECT_LT(std::abs(n.dot(w.col(i))), 1e-15);
          EXPECT_LT(n.cross(removed).norm(), 1e-15);
          break;
        case Freedom::curve:
          EXPECT_LT(t.cross(w.col(i)).norm(), 1e-15);
          EXPECT_LT(std::abs(t.dot(removed)), 1e-15);
          break;
        case Freedom::fixed:
          EXPECT_EQ(w.col(i), Vec3::Zero());
      }
    }
    Mat3X twice = w;
    s->retraction.constrain(s->positions, twice);
    EXPECT_LT((twice - w).norm(), 1e-14);
  }
}

TEST(Retraction, FixedVerticesStandStillAndFreeOnesLeaveTheBoundary) {
  for (BoundaryRule rule : {BoundaryRule::fixed, BoundaryRule::free}) {
    test::SceneOptions options;
    options.constraints.boundary = rule;
    test::Scene s = test::ground_scene(0, options);
    SurfacePositions to;
    s.retraction.step(s.positions, Mat3X::Constant(3, s.positions.points.cols(), -.01), to);
    const bool stays = to.points.col(3) == s.positions.points.col(3);
    EXPECT_EQ(stays, rule == BoundaryRule::fixed);
  }
}

TEST(Retraction, NoVertexGoesBeyondItsReach) {
  test::Scene s = test::ground_scene();
  s.constraints.rest_position = s.positions.points;
  s.constraints.max_travel.assign(s.constraints.freedom.size(), .1 * s.L());
  SurfacePositions at = s.positions, to;
  for (unsigned step = 1; step <= 5; ++step) {
    s.retraction.step(at, test::random_vectors(at.points.cols(), .5 * s.L(), step), to);
    std::swap(at, to);
    EXPECT_LT((at.points - s.positions.points).colwise().norm().maxCoeff(), .11 * s.L());
  }
  EXPECT_GT((at.points - s.positions.points).colwise().norm().maxCoeff(), .09 * s.L());
}

TEST(Retraction, LazyVerticesDriftUntilTheyHaveMovedEnough) {  // on a surface without shape operator
  test::SceneOptions options;
  options.retraction.lazy = .025;
  test::Scene s = test::sphere_scene(.3, options);
  Mat3X u = test::random_vectors(s.positions.points.cols(), 1);
  s.retraction.constrain(s.positions, u);
  u = (.01 * u.colwise().normalized()).eval();
  const long long calls = s.retraction.counts().calls;
  SurfacePositions one, two, three;
  s.retraction.step(s.positions, u, one);
  EXPECT_LT((one.points - s.positions.points - u).norm(), 1e-15);
  s.retraction.step(one, u, two);
  EXPECT_NEAR(two.drift[7], .02, 1e-15);
  EXPECT_EQ(s.retraction.counts().calls, calls);

  s.retraction.step(two, u, three);
  EXPECT_EQ(three.drift[7], 0);
  EXPECT_LT((three.points.colwise().norm().array() - 1).abs().maxCoeff(), 1e-15);
  EXPECT_EQ(s.retraction.counts().calls, calls + u.cols());

  s.retraction.project_drifted(two);
  EXPECT_LT((two.points.colwise().norm().array() - 1).abs().maxCoeff(), 1e-15);
  EXPECT_EQ(*std::ranges::max_element(two.drift), 0);
  const SurfacePositions projected = two;
  s.retraction.project_drifted(two);
  EXPECT_TRUE(test::same(two, projected));
}

TEST(Retraction, LazyVerticesFollowTheBendOfTheSurface) {
  const auto bend = [](float change) {
    return [change](int) { return ShapeOperator{SymmetricMatrix(Eigen::Matrix3d::Identity()), change}; };
  };
  test::SceneOptions options;
  options.retraction = {.lazy = 1, .lazy_error = 1e-2};
  test::Scene s(test::sphere(2, .3, 5), Surface(test::to_unit_sphere, bend(0)), options);
  Mat3X u = test::random_vectors(s.positions.points.cols(), 1);
  s.retraction.constrain(s.positions, u);
  u = (.15 * u.colwise().normalized()).eval();
  const long long calls = s.retraction.counts().calls;
  SurfacePositions to;
  s.retraction.step(s.positions, u, to);
  EXPECT_EQ(s.retraction.counts().calls, calls);
  // The parabola leaves the circle by the fourth order.
  EXPECT_LT((to.points.colwise().norm().array() - 1).abs().maxCoeff(), std::pow(.15, 4));
  for (Eigen::Index v = 0; v < u.cols(); ++v)
    EXPECT_LT((to.normals.col(v) - to.points.col(v).normalized()).norm(), std::pow(.15, 2));

  test::Scene rough(test::sphere(2, .3, 5), Surface(test::to_unit_sphere, bend(1)), options);
  rough.retraction.step(rough.positions, u, to);  // projects: unreliable shape operator
  EXPECT_LT((to.points.colwise().norm().array() - 1).abs().maxCoeff(), 1e-15);
}

TEST(Retraction, CountsEveryCallAndHowItEnded) {
  std::atomic<int> asked = 0;
  const auto surface = [&](const Vec3& x, int hint, double) {
    ++asked;
    Projection projection{x, Vec3::UnitZ(), hint,
                          hint % 2 ? ProjectionStatus::too_far : ProjectionStatus::converged, 3};
    if (hint == 40) projection.evaluations = 0;  // e.g. a closest point, which evaluates no field
    return projection;
  };
  test::Scene s(test::grid(8, test::flat), surface);
  SurfacePositions to;
  s.retraction.step(s.positions, Mat3X::Ones(3, 81), to);
  for (int again = 0; again < 3; ++again) s.retraction.moved(s.positions, 40, Vec3::UnitX());
  for (int again = 0; again < 3; ++again) s.retraction.moved(s.positions, 41, Vec3::UnitX());
  s.retraction.count();
  const ProjectionCounts& counts = s.retraction.counts();
  EXPECT_EQ(counts.calls, asked);
  EXPECT_EQ(counts.by_status[0] + counts.by_status[3], asked);
  EXPECT_EQ(counts.by_status[3], 40 + 40 + 3);
  EXPECT_EQ(counts.evaluations, 3 * (asked - 1 - 1 - 3));
}

TEST(Retraction, OneThreadAndTwoGiveTheSameBits) {
  std::vector<SurfacePositions> to(2);
  for (int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    test::Scene s(test::sphere(3, .3), test::to_unit_sphere);
    s.retraction.step(s.positions, test::random_vectors(642, .05), to[threads - 1]);
  }
  EXPECT_TRUE(test::same(to[0], to[1]));
}

}  // namespace hooke::retraction_test
