#include "hooke/integrator/guards.h"

#include <gtest/gtest.h>

namespace hooke {
namespace {

const GuardOptions options;

TEST(GuardRules, ACreaseKeepsItsSideOfEachLimit) {
  for (const double limit : {options.fold, -options.fold}) {
    EXPECT_TRUE(crease_fold_breaks(options, limit + .1, limit - .1)) << limit;
    EXPECT_FALSE(crease_fold_breaks(options, limit + .1, limit + .01)) << limit;
    EXPECT_FALSE(crease_fold_breaks(options, limit - .01, limit - .1)) << limit;
    EXPECT_FALSE(crease_fold_breaks(options, limit - .1, limit + .1)) << limit;
  }
}

TEST(GuardRules, ACreaseOnALimitMayFallByLessThanTheSlack) {
  EXPECT_FALSE(crease_fold_breaks(options, options.fold, options.fold - .5 * options.slack));
  EXPECT_TRUE(crease_fold_breaks(options, options.fold, options.fold - 2 * options.slack));
}

TEST(GuardRules, ASmoothEdgeBelowTheLimitMayOnlyOpen) {
  EXPECT_TRUE(fold_breaks(options, .5, options.fold - .01));
  EXPECT_FALSE(fold_breaks(options, .5, options.fold + .01));
  EXPECT_FALSE(fold_breaks(options, -.5, -.4));
  EXPECT_TRUE(fold_breaks(options, -.5, -.6));
  EXPECT_FALSE(fold_breaks(options, -.5, -.5 - .5 * options.slack));
}

TEST(GuardRules, AFoldedFaceMayShrinkWhereItTurnsTheRightWay) {
  EXPECT_FALSE(face_breaks(options, 1, .01, -.5, -.4));
  EXPECT_TRUE(face_breaks(options, 1, .01, -.5, -.5));
  EXPECT_TRUE(face_breaks(options, 1, 1, -.5, -.6));
  EXPECT_TRUE(face_breaks(options, 1, .19, .9, .9));
  EXPECT_TRUE(face_breaks(options, 1, 1, .9, .29));
  EXPECT_FALSE(face_breaks(options, 1, .21, .9, .31));
}

TEST(GuardRules, ASagittaAboveItsLimitMayOnlyShrink) {
  const double target = 3;
  EXPECT_FALSE(sagitta_breaks(options, target, 0, .99 * options.sagitta * target));
  EXPECT_TRUE(sagitta_breaks(options, target, 0, 1.01 * options.sagitta * target));
  EXPECT_FALSE(sagitta_breaks(options, target, 2, 1.9));
  EXPECT_TRUE(sagitta_breaks(options, target, 2, 2.1));
}

TEST(GuardRules, OnlyFacesOnTheSurfaceKeepTheirAngles) {
  GuardOptions o;
  o.cotangent = 2;
  EXPECT_TRUE(angle_breaks(o, .9, 1, 2.1));
  EXPECT_FALSE(angle_breaks(o, .9, 1, 1.9));
  EXPECT_FALSE(angle_breaks(o, .9, 3, 2.5));
  EXPECT_FALSE(angle_breaks(o, -.5, 1, 5));
  EXPECT_FALSE(angle_breaks(options, .9, 1, 1e6));
}

}  // namespace
}  // namespace hooke
