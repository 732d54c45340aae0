// Newton's method vertex by vertex about some places of the mesh, where the rest is well as it is.
#pragma once

#include "hooke/integrator/local_newton.h"

namespace hooke {

struct LocalRelaxationOptions {
  int sweeps = 8;
  double over_relaxation = 1;  // more is faster where vertices have far to go, but magnifies rounding
  double rest = 3e-3;          // of a target length; what moves less in a sweep sits out the next
};

struct LocalRelaxationResult {
  int sweeps = 0;
  bool interrupted = false;
};

/// Sweeps over the vertices until all are at rest or the sweeps are used up. Nothing else moves.
LocalRelaxationResult relax_locally(Relaxation& relaxation, const std::vector<int>& vertices,
                                    const LocalRelaxationOptions& options, const Observer& observer);

}  // namespace hooke
