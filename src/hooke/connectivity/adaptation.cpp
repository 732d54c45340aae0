#include "hooke/connectivity/adaptation.h"

#include <algorithm>
#include <cmath>

namespace hooke {
namespace {

class Adaptation {
 public:
  Adaptation(Workspace& work, const AdaptOptions& options, const FlipGuardOptions& flip_guard,
             const GuardOptions& guards, const EnergyTerms& terms, double corner_angle,
             const Observer& observer)
      : options_(options),
        observer_(observer),
        steps_(work, options.steps, flip_guard, terms, guards, corner_angle, watch()) {
    result_.wanted_faces =
        wanted_face_count(work.placement.points, work.connectivity->faces, work.vertex_length);
  }

  /// `folded`: are there faces that lie against the surface? Flow would carry them along where splits and
  /// collapses take them out.
  AdaptResult run(bool folded) {
    steps_.release_bends();
    result_.levels = steps_.bearable_levels(result_.wanted_faces, options_.coarse);
    if (result_.levels > 0)
      refine_coarse_mesh();
    else
      adapt_at_once(folded);
    steps_.finish();
    result_.splits = steps_.counts().splits;
    result_.collapses = steps_.counts().collapses;
    result_.flips = steps_.counts().flips;
    result_.interrupted = steps_.interrupted();
    return result_;
  }

 private:
  /// Without a coarser mesh first.
  void adapt_at_once(bool folded) {
    if (!folded) steps_.settle(options_.first_flow);
    change_lengths(options_.rounds, options_.flow_rounds);
    approach(result_.wanted_faces, options_.count_slack);
  }

  void refine_coarse_mesh() {
    steps_.coarsen(result_.levels);
    change_lengths(options_.rounds, options_.coarse_flow);
    approach(result_.wanted_faces / std::pow(4, result_.levels), options_.count_slack);
    for (int level = result_.levels; level > 0; --level) {
      if (level < result_.levels) settle(options_.coarse_flow);
      if (!steps_.interrupted()) steps_.flip_irregular();
      steps_.quadruple();  // interrupted or not: the target lengths are to be those that were asked for
    }
    change_lengths(options_.fine_rounds, options_.fine_flow);
    approach(result_.wanted_faces, options_.fine_count_slack * result_.wanted_faces);
  }

  void change_lengths(int rounds, int flow_rounds) {
    for (int i = 0; i < rounds && !steps_.interrupted(); ++i) {
      steps_.change_lengths();
      ++result_.rounds;
      settle(flow_rounds);
    }
  }

  void approach(double wanted_faces, double slack) {
    for (int i = 0; i < options_.count_rounds && !steps_.interrupted(); ++i) {
      if (std::abs(steps_.face_count() - wanted_faces) <= slack) return;
      if (!steps_.change_count(wanted_faces)) return;
      ++result_.count_rounds;
      settle(options_.count_flow);
    }
  }

  void settle(int rounds) {
    if (!steps_.interrupted()) steps_.settle(rounds);
  }

  Observer watch() const {
    if (!observer_) return nullptr;
    return [this](Progress p) {
      p.stage = "adapt";
      p.outer = result_.rounds + result_.count_rounds;
      return observer_(p);
    };
  }

  const AdaptOptions& options_;
  const Observer& observer_;
  AdaptationSteps steps_;
  AdaptResult result_;
};

UntangleResult unfold(Workspace& work, const EnergyTerms& terms, const GuardOptions& guard_options,
                      const Observer& observer) {
  Energy energy(*work.connectivity, work.targets, terms);
  Guards guards(*work.connectivity, work.targets, guard_options);
  Relaxation r{*work.connectivity, work.sweeps, work.vertex_length, energy,
               *work.retraction,   guards,      work.placement};
  return untangle(r, UntangleOptions{}, observer);
}

}  // namespace

AdaptOptions adapt_options(Effort effort) {
  AdaptOptions options;
  switch (effort) {
    case Effort::fast:
      options.rounds = 2;
      options.first_flow = 4;
      options.count_flow = 0;
      options.coarse.levels = 3;
      options.coarse_flow = 3;
      options.fine_flow = 1;
      options.steps.spring_steps = 8;
      options.steps.irregular = {.passes = 1};
      options.last_flow = options.last_passes = 0;
      options.last_outer = 1;
      options.last_steps = 1;  // a sweep
      break;
    case Effort::standard:
      break;
    case Effort::thorough:
      options.rounds = 7;
      options.flow_rounds = 8;
      options.coarse_flow = options.fine_flow = 20;
      options.steps.irregular.passes = 8;
      options.steps.irregular.sweeps = 6;
      options.steps.irregular.hope = .6;
      options.steps.irregular.swept_hope = .2;
      options.last_flow = 20;
      options.last_passes = 8;
      break;
  }
  return options;
}

FlipOptions flips_after(const AdaptResult& adapted, const AdaptOptions& options, FlipOptions flips) {
  if (adapted.levels == 0) return flips;
  flips.flow.rounds = std::min(flips.flow.rounds, options.last_flow);
  flips.passes.passes = std::min(flips.passes.passes, options.last_passes);
  return flips;
}

AdaptResult adapt(Workspace& work, const AdaptOptions& options, const FlipGuardOptions& flip_guard,
                  const EnergyTerms& terms, const GuardOptions& guards, double corner_angle,
                  const Observer& observer) {
  const UntangleResult unfolded = unfold(work, terms, guards, observer);
  AdaptResult result;
  if (unfolded.interrupted)
    result.interrupted = true;
  else
    result = Adaptation(work, options, flip_guard, guards, terms, corner_angle, observer)
                 .run(!unfolded.folded.empty());
  result.untangle = unfolded;
  return result;
}

}  // namespace hooke
