#include "hooke/connectivity/edge_trial.h"

#include <gtest/gtest.h>

#include "adapting_scene.h"
#include "hooke/integrator/guards.h"

namespace hooke {
namespace {

constexpr double sliver_angle = 35;

std::vector<EdgeChange> changes_of(const test::AdaptingScene& s) {
  std::vector<EdgeChange> changes;
  for (int h = 0; h < s.triangulation.half_edge_count(); ++h) {
    if (s.triangulation.twin(h) > h || is_rim(s.triangulation, h)) continue;
    const std::vector<EdgeChange> allowed = allowed_changes(s.adapting, h, {});
    changes.insert(changes.end(), allowed.begin(), allowed.end());
  }
  return changes;
}

/// The trials that are worth keeping.
std::vector<ChangeTrial> kept(const test::AdaptingScene& s, const ChangeTrialOptions& options) {
  const EnergyTerms terms;
  ChangeTrials trials(s.adapting, terms, options, {});
  trials.begin_with(sliver_angle);
  std::vector<ChangeTrial> kept;
  for (const EdgeChange& change : changes_of(s)) {
    ChangeTrial trial = trials.begin(change);
    if (!trial.is_hopeful) continue;
    trials.finish(trial);
    if (trial.is_hopeful) kept.push_back(std::move(trial));
  }
  return kept;
}

PatchLook look_after(const ChangeTrial& trial, const ChangeTrialOptions& o) {
  const GuardOptions guards;
  return look_at(trial.patch.placement, trial.connectivity, trial.targets,
                 {sliver_angle + o.fair_margin, guards.alignment, guards.fold, o.sagitta, o.longest});
}

test::AdaptingScene rough_sphere() {
  return {test::sphere(2, .4), test::unit_sphere()};
}

TEST(ChangeTrial, LeavesTheMeshAlone) {
  const test::AdaptingScene s = rough_sphere();
  const Mat3X points = s.placement.points;
  const std::vector<Triangle> faces = s.triangulation.faces();
  EXPECT_FALSE(kept(s, {}).empty());
  EXPECT_EQ(s.placement.points, points);
  EXPECT_EQ(s.triangulation.faces(), faces);
}

TEST(ChangeTrial, WhatIsKeptGainsAndKeepsTheLeastAngle) {
  const ChangeTrialOptions options;
  for (const ChangeTrial& trial : kept(rough_sphere(), options)) {
    EXPECT_GE(trial.gain, options.gain);
    EXPECT_LE(look_after(trial, options).cotangent, trial.before.cotangent);
  }
}

/// Of a rough sphere most changes cover more: here they have to.
TEST(ChangeTrial, LosesNoMoreSurfaceThanItMay) {
  const test::AdaptingScene s = rough_sphere();
  const ChangeTrialOptions any, more{.area_loss = -.1};
  const std::vector<ChangeTrial> all = kept(s, any), covering = kept(s, more);
  EXPECT_LT(covering.size(), all.size());
  EXPECT_FALSE(covering.empty());
  for (const ChangeTrial& trial : covering) {
    const double length = trial.patch.vertex_length[0];
    EXPECT_GE(look_after(trial, more).area, trial.before.area + .1 * length * length - 1e-12);
  }
}

TEST(ChangeTrial, IsOverWithoutHope) {
  const test::AdaptingScene s = rough_sphere();
  EXPECT_TRUE(kept(s, {.hope = -1e9}).empty());
  EXPECT_TRUE(kept(s, {.most = 1}).empty());
}

}  // namespace
}  // namespace hooke
