// Relaxation by L-BFGS on the surface. J. Nocedal, "Updating quasi-Newton matrices with limited storage",
// 1980. Every trial step is retracted through the filter and guarded per vertex before its energy counts.
#pragma once

#include "hooke/integrator.h"

namespace hooke {

struct LbfgsOptions {
  int memory = 8;           // pairs of steps and gradient changes
  double first_step = .1;   // of the gradient, while there is no memory
  double armijo = 1e-4;     // part of the predicted decrease that a step must bring
  int max_backtracks = 12;  // halvings of a step before it is given up
};

/// Moves relaxation.placement to a minimum of relaxation.energy on the surface.
IntegrationResult relax_lbfgs(Relaxation& relaxation, const IntegrationOptions& options,
                              const LbfgsOptions& lbfgs, const Observer& observer);

}  // namespace hooke
