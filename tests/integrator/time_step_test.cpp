#include "hooke/integrator/time_step.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/meshes.h"

#include "hooke/mesh/adjacency.h"

namespace hooke::time_step_test {

using test::Triangles;

/// One right triangle with legs of length 1 in the plane z = 0.
const Mat3X corner = (Mat3X(3, 3) << 0, 1, 0, 0, 0, 1, 0, 0, 0).finished();
const Adjacency one_face = make_adjacency(3, {{0, 1, 2}});

/// All tests but the chosen one are out of reach.
TimeStepOptions loose() {
  return {.angle = -2, .expansion = 1e9, .displacement = 1e9, .area_bound = -1};
}

TEST(BaseStep, IsTheRootOfTheInequality) {
  for (const double v : {1e-12, 1., 1e9})
    for (const double f : {1e-12, 1., 1e9}) {
      const double w = base_step({.edge = .3, .velocity = v, .force = f}, .01);
      EXPECT_NEAR((f / .02 * w * w + v * w) / .3, 1, 1e-12) << v << " " << f;
    }
}

TEST(BaseStep, HasItsLimitsWithoutVelocityOrForce) {
  EXPECT_DOUBLE_EQ(base_step({.edge = 3, .velocity = 2, .force = 0}, .01), 1.5);
  EXPECT_DOUBLE_EQ(base_step({.edge = 2, .velocity = 0, .force = 4}, .25), .5);
  EXPECT_FALSE(std::isfinite(base_step({.edge = 2, .velocity = 0, .force = 0}, .25)));
}

TEST(StepScales, AreTheExtremesAndSkipEdgesOfLengthZero) {
  Triangles t = test::grid(2, test::flat);
  const Adjacency c = make_adjacency(9, t.faces);
  Mat3X u = Mat3X::Zero(3, 9), f = Mat3X::Zero(3, 9);
  u.col(4) = Vec3(3, 0, 4);
  f.col(7) = Vec3(0, -2, 0);
  t.points.col(1) = t.points.col(0);
  const StepScales s = step_scales(t.points, u, f, c);
  EXPECT_DOUBLE_EQ(s.edge, .5);
  EXPECT_DOUBLE_EQ(s.velocity, 5);
  EXPECT_DOUBLE_EQ(s.force, 2);
}

TEST(StepTests, AngleBindsAtItsCosine) {
  TimeStepOptions o = loose();
  o.angle = std::cos(.1);
  const auto turned = [](double a) -> Mat3X { return Eigen::AngleAxisd(a, Vec3::UnitX()) * corner; };
  EXPECT_FALSE(test_step(corner, turned(.099), one_face, 1, o).any());
  EXPECT_TRUE(test_step(corner, turned(.101), one_face, 1, o).angle);
}

TEST(StepTests, ExpansionBindsBothWays) {
  TimeStepOptions o = loose();
  o.expansion = .01;
  const auto stretched = [](double s) -> Mat3X { return Vec3(s, 1, 1).asDiagonal() * corner; };
  EXPECT_FALSE(test_step(corner, stretched(1.0099), one_face, 1, o).any());
  EXPECT_FALSE(test_step(corner, stretched(.9901), one_face, 1, o).any());
  EXPECT_TRUE(test_step(corner, stretched(1.0101), one_face, 1, o).expansion);
  EXPECT_TRUE(test_step(corner, stretched(.9899), one_face, 1, o).expansion);
}

TEST(StepTests, ExpansionForbidsAFaceToVanish) {
  EXPECT_TRUE(test_step(corner, Vec3(0, 1, 1).asDiagonal() * corner, one_face, 1, loose()).expansion);
}

TEST(StepTests, DisplacementIsMeasuredByTheShortestEdge) {
  TimeStepOptions o = loose();
  o.displacement = .01;
  const auto shifted = [](double d) -> Mat3X { return corner.colwise() + Vec3(0, 0, d); };
  EXPECT_FALSE(test_step(corner, shifted(.0199), one_face, 2, o).any());
  EXPECT_TRUE(test_step(corner, shifted(.0201), one_face, 2, o).displacement);
}

TEST(StepTests, AreaBoundHoldsAfterTheStep) {
  TimeStepOptions o = loose();
  o.area_bound = .45;
  EXPECT_FALSE(test_step(corner, corner, one_face, 1, o).any());
  EXPECT_TRUE(test_step(corner, Vec3(.8, 1, 1).asDiagonal() * corner, one_face, 1, o).area_bound);
}

TEST(StepTests, ExemptAFaceThatWasDegenerateBefore) {
  const Mat3X flat = Vec3(1, 0, 1).asDiagonal() * corner;
  EXPECT_FALSE(test_step(flat, flat, one_face, 1, {}).any());
  Mat3X opened = flat;
  opened(1, 2) = .005;
  EXPECT_FALSE(test_step(flat, opened, one_face, 1, {}).any());
}

TEST(StepTests, FailOnNaN) {
  const Mat3X nan = Mat3X::Constant(3, 3, std::numeric_limits<double>::quiet_NaN());
  const FailedTests failed = test_step(corner, nan, one_face, 1, {});
  EXPECT_TRUE(failed.angle && failed.expansion && failed.displacement && failed.area_bound);
}

/// Passes up to the given time, else fails the expansion test.
auto up_to(double longest) {
  return [=](double dt) { return FailedTests{.expansion = dt > longest}; };
}

TEST(AdaptStep, GrowsAtMostTwiceAndHalvesUntilItPasses) {
  const AdaptedStep free = adapt_step(3, initial_factor, 1e-6, up_to(1e9));
  EXPECT_EQ(free.factor, 1);
  EXPECT_EQ(free.time, 3);
  EXPECT_FALSE(free.bound.any());
  const AdaptedStep cut = adapt_step(3, initial_factor, 1e-6, up_to(.4));
  EXPECT_EQ(cut.factor, .125);
  EXPECT_EQ(cut.time, .375);
  EXPECT_EQ(cut.rejected, 3);
  EXPECT_TRUE(cut.bound.expansion);
  EXPECT_FALSE(cut.bound.angle);
}

TEST(AdaptStep, ReportsAJamUnderTheFloor) {
  const AdaptedStep jam = adapt_step(3, initial_factor, 1e-3, up_to(1e-9));
  EXPECT_TRUE(jam.jammed);
  EXPECT_TRUE(jam.bound.expansion);
  EXPECT_EQ(jam.time, 0);
}

}  // namespace hooke::time_step_test
