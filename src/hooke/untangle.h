// Faces that lie folded away from the surface, before the springs: unsigned altitudes would push them the
// wrong way, so they first feel a spring on their signed area.
#pragma once

#include "hooke/lbfgs.h"

namespace hooke {

struct UntangleOptions {
  int max_rounds = 10;
  int evaluations = 30;  // per round
};

struct UntangleResult {
  int folded_before = 0;
  std::vector<int> folded;  // faces that are still folded, in the numbering of the connectivity
  int evaluations = 0;
  bool interrupted = false;
};

/// Unfolds faces whose alignment with the surface is below the guards' threshold, as far as possible.
UntangleResult untangle(Relaxation& relaxation, const UntangleOptions& options, const Observer& observer);

}  // namespace hooke
