#include "hooke/filter/newton_projection.h"

#include <gtest/gtest.h>

namespace hooke::newton_projection_test {

FieldSample unit_sphere(const Vec3& x, int) {
  return {x.squaredNorm() - 1, 2 * x};
}

ProjectionStatus status_on(const ScalarField& psi) {
  return project_by_newton(psi, Vec3(.1, .2, .3), 0, {}).status;
}

TEST(Projection, ReachesTheZeroLevelWithinTheTolerance) {
  for (double tolerance : {1e-3, 1e-6, 1e-12}) {
    const Vec3 x(1.2, .3, -.4);
    const Projection projection = project_by_newton(unit_sphere, x, 7, {.tolerance = tolerance});
    EXPECT_EQ(projection.status, ProjectionStatus::converged);
    EXPECT_EQ(projection.hint, 7);
    EXPECT_LE(std::abs(projection.point.norm() - 1), 1.1 * tolerance);
    EXPECT_NEAR(projection.normal.norm(), 1, 1e-15);
    EXPECT_LT((projection.point - x.normalized()).norm(), 1e-3);
    EXPECT_LT((projection.normal - x.normalized()).norm(), 1e-2);
  }
}

TEST(Projection, LeavesAPointOnTheSurfaceWhereItIs) {
  const Projection projection = project_by_newton(unit_sphere, Vec3::UnitX(), 0, {});
  EXPECT_EQ(projection.point, Vec3::UnitX());
  EXPECT_EQ(projection.evaluations, 1);
}

TEST(Projection, SaysWhyItFails) {
  EXPECT_EQ(status_on([](const Vec3&, int) { return FieldSample{}; }), ProjectionStatus::no_cover);
  EXPECT_EQ(status_on([](const Vec3&, int) {
              return FieldSample{1, .009 * Vec3::UnitZ()};
            }),
            ProjectionStatus::flat_gradient);
  EXPECT_EQ(status_on([](const Vec3&, int) {
              return FieldSample{1, Vec3::UnitZ()};
            }),
            ProjectionStatus::too_far);
  EXPECT_EQ(status_on([](const Vec3& x, int) {
              return FieldSample{x[2] > .25 ? .1 : -.1, Vec3::UnitZ()};
            }),
            ProjectionStatus::step_limit);
  EXPECT_EQ(status_on([](const Vec3&, int) {
              return FieldSample{NAN, Vec3::Constant(NAN)};
            }),
            ProjectionStatus::flat_gradient);
}

TEST(Projection, ShortensLongSteps) {
  Vec3 last = Vec3::Zero();
  double longest = 0;
  const auto watch = [&](const Vec3& x, int) {
    longest = std::max(longest, (x - last).norm());
    last = x;
    return FieldSample{.25 * (x[2] - 1.9), .25 * Vec3::UnitZ()};
  };
  EXPECT_EQ(project_by_newton(watch, Vec3::Zero(), 0, {}).status, ProjectionStatus::converged);
  EXPECT_NEAR(longest, .5, 1e-12);
}

}  // namespace hooke::newton_projection_test
