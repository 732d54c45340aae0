#include "hooke/remesh/options.h"

namespace hooke {
namespace {

/// Less flow and fewer springs: the vertices are distributed after the adaptation.
void set_flips_after_adaptation(FlipOptions& flips, Effort effort) {
  switch (effort) {
    case Effort::fast:
      flips.flow.rounds = 12;
      flips.spring_rounds = 0;  // those before the pass suffice
      flips.passes.passes = 1;
      flips.passes.rounds = 3;
      flips.passes.sweeps = 2;
      flips.passes.max_energy_rise = .3;
      flips.passes.max_rise_after_relaxation = .04;
      break;
    case Effort::standard:
      flips.flow.rounds = 20;
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

}  // namespace

void set_effort(RemeshOptions& options, Effort effort) {
  options.flips = flip_options(effort);
  options.adaptation = adapt_options(effort);
  if (options.connectivity == ConnectivityMode::adapt) set_flips_after_adaptation(options.flips, effort);
  if (options.connectivity != ConnectivityMode::fixed) {
    set_sliver_removal(options.slivers.pass, options.connectivity, effort);
    return;
  }
  switch (effort) {
    case Effort::fast:  // one outer iteration, and angle springs in a single stage
      options.max_outer = 1;
      options.angle_springs.first_threshold = options.angle_springs.last_threshold = 24;
      options.angle_springs.sweeps = 8;
      break;
    case Effort::standard:
      break;
    case Effort::thorough:  // smaller stages; edges may become a little less equal
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

}  // namespace hooke
