#include "hooke/filter/surface.h"

#include <gtest/gtest.h>

#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/normals.h"
#include "support/scene.h"

namespace hooke::surface_test {

std::vector<ShapeOperator> bends_of(const test::Triangles& t) {
  const Adjacency c = test::connect(t);
  return shape_operators(t.points, vertex_normals(t.points, c), c);
}

TEST(ShapeOperator, ASphereTurnsByTheWayOverItsRadius) {
  for (double jitter : {0., .3}) {
    test::Triangles t = test::sphere(3, jitter, 2);
    t.points *= 5;
    const std::vector<ShapeOperator> shape_operators = bends_of(t);
    for (size_t v = 0; v < shape_operators.size(); ++v) {
      const Vec3 n = t.points.col(static_cast<Eigen::Index>(v)).normalized();
      const Vec3 direction = n.unitOrthogonal();
      EXPECT_LT((shape_operators[v].shape * direction - direction / 5).norm(), 1e-3 / 5);
      EXPECT_LT((shape_operators[v].shape * n).norm(), 1e-6);
      EXPECT_LT(shape_operators[v].change, .02 / 5);
    }
  }
}

TEST(ShapeOperator, ACylinderBendsAcrossItsAxisOnly) {
  test::Triangles t = test::grid(24, test::flat);
  for (auto p : t.points.colwise()) p = Vec3(.5 * std::sin(2 * p[0]), p[1], .5 * std::cos(2 * p[0]));
  const Adjacency c = test::connect(t);
  const std::vector<ShapeOperator> shape_operators = bends_of(t);
  for (int v = 0; v < c.vertex_count; ++v) {
    if (c.vertex_faces[v].size() != c.vertex_neighbours[v].size()) continue;  // on the boundary
    const Vec3 p = t.points.col(v), across(2 * p[2], 0, -2 * p[0]);
    EXPECT_LT((shape_operators[v].shape * Vec3::UnitY()).norm(), .1 * 2);
    EXPECT_LT((shape_operators[v].shape * across - 2 * across).norm(), .3 * 2);
  }
}

TEST(ShapeOperator, APlaneDoesNotBendAndALoneVertexSaysNothing) {
  test::Triangles t = test::moved(test::grid(6, test::flat, .4));
  t.points.conservativeResize(3, t.points.cols() + 1);
  t.points.rightCols(1).setConstant(7);
  std::vector<ShapeOperator> shape_operators = bends_of(t);
  EXPECT_TRUE(std::isinf(shape_operators.back().change));
  shape_operators.pop_back();
  for (const ShapeOperator& b : shape_operators) {
    EXPECT_LT((b.shape * Vec3(1, 2, 3)).norm(), 1e-12);
    EXPECT_LT(b.change, 1e-12);
  }
}

TEST(ShapeOperator, SaysNothingWhereEdgesDoNotSpanAPlane) {
  test::Triangles t = test::grid(6, test::paraboloid);
  t.points.row(0) *= 100;
  for (const ShapeOperator& b : bends_of(t)) EXPECT_TRUE(std::isinf(b.change));
}

TEST(ShapeOperator, IsOneOverTheLength) {
  const test::Triangles t = test::grid(8, test::paraboloid, .3);
  const std::vector<ShapeOperator> once = bends_of(t), twice = bends_of({2 * t.points, t.faces});
  for (size_t v = 0; v < once.size(); ++v) {
    EXPECT_EQ(twice[v].shape.xx, once[v].shape.xx / 2);
    EXPECT_EQ(twice[v].change, once[v].change / 2);
  }
}

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

}  // namespace hooke::surface_test
