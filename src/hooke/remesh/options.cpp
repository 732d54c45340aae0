#include "hooke/remesh/options.h"

namespace hooke {
namespace {

/// Adaptation has spread the vertices out.
void set_flips_after_adaptation(FlipOptions& flips, Effort effort) {
  switch (effort) {
    case Effort::fast:
      flips.flow.rounds = 12;
      flips.spring_rounds = 0;  // those before the pass do
      flips.passes.passes = 1;
      flips.passes.rounds = 3;
      flips.passes.sweeps = 2;
      flips.passes.hope = .3;
      flips.passes.swept_hope = .04;
      break;
    case Effort::standard:
      flips.flow.rounds = 20;
      break;
    case Effort::thorough:
      break;
  }
}

/// Flips alone pay for a larger least angle with their edges' lengths.
void set_mending(SliverTrialOptions& trials, ConnectivityMode mode, Effort effort) {
  const bool adapts = mode == ConnectivityMode::adapt;
  switch (effort) {
    case Effort::fast:
      trials.rounds = 2;
      trials.sliver_angles = {30};
      break;
    case Effort::standard:
      if (!adapts) trials.sliver_angles = {25, 30, 35};
      break;
    case Effort::thorough:
      trials.searched = 100;
      if (adapts) trials.sliver_angles = {25, 30, 35, 40, 45};
      break;
  }
}

}  // namespace

void set_effort(RemeshOptions& options, Effort effort) {
  options.flips = flip_options(effort);
  options.adaptation = adapt_options(effort);
  if (options.connectivity == ConnectivityMode::adapt) set_flips_after_adaptation(options.flips, effort);
  if (options.connectivity != ConnectivityMode::fixed) {
    set_mending(options.mend.trials, options.connectivity, effort);
    return;
  }
  switch (effort) {
    case Effort::fast:  // one round, and angle springs once, not in rising stages
      options.max_outer = 1;
      options.polish.first_threshold = options.polish.last_threshold = 24;
      options.polish.sweeps = 8;
      break;
    case Effort::standard:
      break;
    case Effort::thorough:  // smaller stages, and edges pay a little for the angles
      options.max_outer = 12;
      options.integration.energy_drop = 2e-3;
      options.outer_drop = 1e-3;
      options.polish.sweeps = 24;
      options.polish.rest = 3e-3;
      options.polish.threshold_step = 1;
      options.polish.least_step = .5;
      options.polish.last_threshold = 40;
      options.polish.edge_error_limit = 1.05;
      options.polish.keep_within = 0;
      break;
  }
}

}  // namespace hooke
