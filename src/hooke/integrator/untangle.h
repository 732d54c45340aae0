// Unfolds faces that lie folded away from the surface, before the springs act: springs on unsigned altitudes
// would push such faces the wrong way, so a spring on their signed area unfolds them first.
#pragma once

#include "hooke/core/types.h"
#include "hooke/integrator/integration.h"

namespace hooke {

struct Relaxation;

struct UntangleResult {
  int folded_before = 0;
  std::vector<int> folded;  // ids in the adjacency of the faces that are still folded
  int sweeps = 0;
  bool interrupted = false;
};

/// Unfolds, as far as possible, the faces whose alignment with the surface is below the guards' limit.
UntangleResult untangle(Relaxation& relaxation, const Observer& observer);

}  // namespace hooke
