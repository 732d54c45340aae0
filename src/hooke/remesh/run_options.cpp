#include "hooke/remesh/run_options.h"

namespace hooke {
namespace {

/// Less of everything: a third to half of the time.
void set_fast(RunOptions& o) {
  if (o.chosen.connectivity == ConnectivityMode::fixed) {  // one iteration, angle springs in a single stage
    o.max_outer = 1;
    o.angle_springs.first_threshold = o.angle_springs.last_threshold = 24;
    o.angle_springs.sweeps = 8;
    return;
  }
  o.slivers.rounds = 2;
  o.slivers.sliver_angles = {30};
  FlipOptions& flips = o.flips;
  flips.spring_steps = 8;
  flips.energy_drop = 1e-2;
  flips.angle_springs.last_threshold = 36;
  flips.angle_springs.sweeps = 4;
  if (o.chosen.connectivity == ConnectivityMode::flip) {
    flips.flow_rounds = 9;
    flips.spring_rounds = 1;
    flips.passes.passes = 0;
    return;
  }
  flips.flow_rounds = 12;
  flips.spring_rounds = 0;  // those before the pass suffice
  flips.passes = {
      .passes = 1, .rounds = 3, .sweeps = 2, .max_energy_rise = .3, .max_rise_after_relaxation = .04};
  AdaptOptions& adaptation = o.adaptation;
  adaptation.rounds = 2;
  adaptation.first_flow = 4;
  adaptation.count_flow = 0;
  adaptation.coarse.levels = 3;
  adaptation.coarse_flow = 3;
  adaptation.fine_flow = 1;
  adaptation.spring_steps = 8;
  adaptation.irregular = {.passes = 1};
  adaptation.last_flow = adaptation.last_passes = 0;
  adaptation.last_outer = 1;
  adaptation.last_steps = 1;  // one sweep
}

/// The defaults, but for what depends on the mode.
void set_standard(RunOptions& o) {
  if (o.chosen.connectivity == ConnectivityMode::adapt)
    o.flips.flow_rounds = 20;  // the vertices are distributed after the adaptation
  else                         // flips alone reach larger angles only with less equal edges
    o.slivers.sliver_angles = {25, 30, 35};
}

/// More of everything, as long as it gains something; edges may become a little less equal for the angles.
void set_thorough(RunOptions& o) {
  if (o.chosen.connectivity == ConnectivityMode::fixed) {  // more iterations and stages
    o.max_outer = 12;
    o.integration.energy_drop = 2e-3;
    o.outer_drop = 1e-3;
    o.angle_springs.sweeps = 24;
    o.angle_springs.rest = 3e-3;
    o.angle_springs.threshold_step = 1;
    o.angle_springs.min_step = .5;
    o.angle_springs.last_threshold = 40;
    o.angle_springs.edge_error_limit = 1.05;
    o.angle_springs.keep_within = 0;
    return;
  }
  o.slivers.searched = 100;
  FlipOptions& flips = o.flips;
  flips.flow_rounds = 200;
  flips.few_flips = 0;
  flips.passes = {
      .passes = 8, .rings = 3, .sweeps = 6, .max_energy_rise = .6, .max_rise_after_relaxation = .2};
  if (o.chosen.connectivity == ConnectivityMode::flip) return;
  o.slivers.sliver_angles = {25, 30, 35, 40, 45};
  AdaptOptions& adaptation = o.adaptation;
  adaptation.rounds = 7;
  adaptation.flow_rounds = 8;
  adaptation.coarse_flow = adaptation.fine_flow = 20;
  adaptation.irregular.passes = 8;
  adaptation.irregular.sweeps = 6;
  adaptation.irregular.max_energy_rise = .6;
  adaptation.irregular.max_rise_after_relaxation = .2;
  adaptation.last_flow = 20;
  adaptation.last_passes = 8;
}

}  // namespace

RunOptions::RunOptions(const RemeshOptions& options) : chosen(options) {
  switch (options.effort) {
    case Effort::fast:
      set_fast(*this);
      break;
    case Effort::standard:
      set_standard(*this);
      break;
    case Effort::thorough:
      set_thorough(*this);
      break;
  }
  adaptation.min_length = options.min_length;
  adaptation.gradation = options.gradation;
  if (options.max_outer) max_outer = adaptation.last_outer = *options.max_outer;
  if (options.max_steps) {
    integration.max_steps = *options.max_steps;
    adaptation.last_steps = *options.max_steps;
  }
}

}  // namespace hooke
