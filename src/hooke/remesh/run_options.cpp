#include "hooke/remesh/run_options.h"

namespace hooke {
namespace {

/// Less flow and fewer springs: the vertices are distributed after the adaptation.
void set_flips_after_adaptation(FlipOptions& flips, Effort effort) {
  switch (effort) {
    case Effort::fast:
      flips.flow_rounds = 12;
      flips.spring_rounds = 0;  // those before the pass suffice
      flips.passes.passes = 1;
      flips.passes.rounds = 3;
      flips.passes.sweeps = 2;
      flips.passes.max_energy_rise = .3;
      flips.passes.max_rise_after_relaxation = .04;
      break;
    case Effort::standard:
      flips.flow_rounds = 20;
      break;
    case Effort::thorough:
      break;
  }
}

/// Mode `flip` omits the larger sliver angles: flips alone reach them only with less equal edges.
void set_sliver_removal(SliverOptions& slivers, ConnectivityMode mode, Effort effort) {
  const bool adapts = mode == ConnectivityMode::adapt;
  switch (effort) {
    case Effort::fast:
      slivers.rounds = 2;
      slivers.sliver_angles = {30};
      break;
    case Effort::standard:
      if (!adapts) slivers.sliver_angles = {25, 30, 35};
      break;
    case Effort::thorough:
      slivers.searched = 100;
      if (adapts) slivers.sliver_angles = {25, 30, 35, 40, 45};
      break;
  }
}

/// One outer iteration with angle springs in a single stage, or more of both in smaller stages, after which
/// edges may be a little less equal.
void set_outer_iterations(RunOptions& options, Effort effort) {
  switch (effort) {
    case Effort::fast:
      options.max_outer = 1;
      options.angle_springs.first_threshold = options.angle_springs.last_threshold = 24;
      options.angle_springs.sweeps = 8;
      break;
    case Effort::standard:
      break;
    case Effort::thorough:
      options.max_outer = 12;
      options.integration.energy_drop = 2e-3;
      options.outer_drop = 1e-3;
      options.angle_springs.sweeps = 24;
      options.angle_springs.rest = 3e-3;
      options.angle_springs.threshold_step = 1;
      options.angle_springs.min_step = .5;
      options.angle_springs.last_threshold = 40;
      options.angle_springs.edge_error_limit = 1.05;
      options.angle_springs.keep_within = 0;
      break;
  }
}

}  // namespace

RunOptions::RunOptions(const RemeshOptions& options)
    : chosen(options), flips(flip_options(options.effort)), adaptation(adapt_options(options.effort)) {
  if (options.connectivity == ConnectivityMode::adapt) set_flips_after_adaptation(flips, options.effort);
  if (options.connectivity == ConnectivityMode::fixed)
    set_outer_iterations(*this, options.effort);
  else
    set_sliver_removal(slivers, options.connectivity, options.effort);
  adaptation.min_length = options.min_length;
  adaptation.gradation = options.gradation;
  if (options.max_outer) max_outer = adaptation.last_outer = *options.max_outer;
  if (options.max_steps) {
    integration.max_steps = *options.max_steps;
    adaptation.last_steps = *options.max_steps;
  }
}

}  // namespace hooke
