#include "hooke/effort.h"

namespace hooke {

void set_effort(RemeshOptions& options, Effort effort) {
  options.flips = flip_options(effort);
  options.adaptation = adapt_options(effort);
  if (options.connectivity == ConnectivityMode::adapt && effort == Effort::fast)
    options.flips.flow.rounds = 24;  // where others make edges that are more even
  if (options.connectivity != ConnectivityMode::fixed) return;
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
      options.outer_drop = 1e-3;
      options.polish.sweeps = 24;
      options.polish.threshold_step = 1;
      options.polish.least_step = .5;
      options.polish.last_threshold = 40;
      options.polish.edge_error_limit = 1.05;
      options.polish.keep_within = 0;
      break;
  }
}

}  // namespace hooke
