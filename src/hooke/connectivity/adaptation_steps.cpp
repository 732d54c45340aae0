#include "hooke/connectivity/adaptation_steps.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hooke/connectivity/flow.h"
#include "hooke/connectivity/subdivision.h"
#include "hooke/integrator/lbfgs.h"
#include "hooke/mesh/creases.h"

namespace hooke {

AdaptationSteps::AdaptationSteps(Workspace& work, const StepOptions& options,
                                 const FlipGuardOptions& flip_guard, const EnergyTerms& terms,
                                 const GuardOptions& guards, double corner_angle, Observer observer)
    : work_(work),
      options_(options),
      flip_guard_(flip_guard),
      terms_(terms),
      guards_(guards),
      observer_(std::move(observer)),
      adapting_(work, corner_angle),
      graded_(work.graded()) {}

void AdaptationSteps::release_bends() {
  count_curve_edges(m_, options_.chord_error);
  Constraints& constraints = work_.constraints;
  for (size_t v = 0; v < constraints.freedom.size(); ++v) {
    if (!constraints.at_bend(static_cast<int>(v))) continue;
    const auto curve = static_cast<size_t>(constraints.curve[v]);
    const double wanted = m_.curve_edges.wanted[curve], ratio = wanted / m_.curve_edges.present[curve];
    if (std::max(ratio, 1 / ratio) > options_.keep_bends) constraints.freedom[v] = Freedom::curve;
  }
}

void AdaptationSteps::coarsen(int levels) {
  level_ += levels;
  for (double& length : work_.vertex_length) length = std::ldexp(length, levels);
}

int AdaptationSteps::bearable_levels(double wanted_faces, const CoarseLimits& limits) const {
  return coarse_levels(adapting_.mesh(), wanted_faces, limits);
}

void AdaptationSteps::change_lengths() {
  count_curve_edges(m_, options_.chord_error);
  // Splits leave flat faces, which collapses would keep. Where there are none, flips before the collapses
  // gain nothing: most of their edges go.
  if (const int splits =
          timed(work_.stopwatch, "splits", [&] { return split_long_edges(m_, options_.split); })) {
    counts_.splits += splits;
    FlippingMesh flipping = m_.flipping();
    counts_.flips += flip_to_delaunay(flipping, flip_guard_);
  }
  {
    const Stage stage(work_.stopwatch, "collapses");
    counts_.collapses += collapse_short_edges(m_, options_.collapse);
    counts_.collapses += collapse_folded_faces(m_, options_.folded);
  }
  add(settle_curves(m_, options_.count));
  give_up_unused_ids();
}

bool AdaptationSteps::change_count(double wanted_faces) {
  count_curve_edges(m_, options_.chord_error);
  add(settle_curves(m_, options_.count));
  const CountChanges inner = approach_count(m_, wanted_faces, options_.count);
  give_up_unused_ids();
  add(inner);
  return inner.splits + inner.collapses > 0;
}

void AdaptationSteps::settle(int rounds) {
  const Stage stage(work_.stopwatch, "flow");
  FlippingMesh flipping = m_.flipping();
  counts_.flips += flip_to_delaunay(flipping, flip_guard_) + force_corners(flipping, flip_guard_);
  FlowOptions options;
  options.rounds = rounds;
  const FlowResult flowed = flow(flipping, options, flip_guard_, guards_, observer_);
  counts_.flips += flowed.flips;
  interrupted_ = flowed.interrupted;
  resample_lengths();
}

void AdaptationSteps::flip_irregular() {
  std::vector<char> lately_changed;
  for (int pass = 0; pass < options_.irregular.passes && !interrupted_; ++pass) {
    settle_springs();
    if (interrupted_ || pass_over_irregular(lately_changed) == 0) return;
  }
}

int AdaptationSteps::pass_over_irregular(std::vector<char>& lately_changed) {
  const Stage stage(work_.stopwatch, "irregular");
  const Observer watch = [this](const Progress& p) {
    interrupted_ = observer_ && !observer_(p);
    return !interrupted_;
  };
  FlippingMesh flipping = m_.flipping();
  const int flips =
      flip_irregular_edges(flipping, terms_, options_.irregular, flip_guard_, guards_, lately_changed, watch);
  resample_lengths();
  counts_.flips += flips;
  return flips;
}

void AdaptationSteps::quadruple() {
  const Stage stage(work_.stopwatch, "quadruple");
  count_curve_edges(m_, options_.chord_error);
  counts_.splits += subdivide(m_, options_.split, flip_guard_);
  give_up_unused_ids();
  coarsen(-1);
}

void AdaptationSteps::give_up_unused_ids() {
  const Stage stage(work_.stopwatch, "compact");
  compact(m_);
}

void AdaptationSteps::settle_springs() {
  const Stage stage(work_.stopwatch, "springs");
  Connectivity c = connectivity_of(m_.triangulation, static_cast<int>(m_.placement.points.cols()));
  part_at_creases(c, m_.constraints.creases);
  const SweepPlan sweeps = plan_sweeps(c);
  const TargetLengths targets = spread_target_lengths(c, m_.vertex_length);
  Energy energy(c, targets, terms_);
  Guards guards(c, targets, guards_);
  Relaxation r{c, sweeps, m_.vertex_length, energy, m_.retraction, guards, m_.placement, work_.stopwatch};
  IntegrationOptions integration;
  integration.max_steps = options_.spring_steps;
  LbfgsOptions lbfgs;
  lbfgs.sweeps = 0;  // flow has left no slivers for them
  lbfgs.settles = false;
  interrupted_ = relax_lbfgs(r, integration, lbfgs, observer_).reason == StopReason::interrupted;
  resample_lengths();
}

void AdaptationSteps::resample_lengths() {
  if (!graded_) return;
  work_.vertex_length = work_.input_lengths();
  coarsen(std::exchange(level_, 0));
}

void AdaptationSteps::add(const CountChanges& changes) {
  counts_.splits += changes.splits;
  counts_.collapses += changes.collapses;
}

}  // namespace hooke
