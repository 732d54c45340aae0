// Faces that lie folded away from the surface, before the springs: unsigned altitudes would push them the
// wrong way, so they first feel a spring on their signed area.
#pragma once

#include "hooke/integrator/relaxation.h"

namespace hooke {

struct UntangleOptions {
  int rounds = 12;               // at most; each takes in more about the folded faces than the one before
  int first_rings = 2;           // about the folded faces, within which vertices move in the first round
  int more_rings = 2;            // in each round
  int sweeps = 30;               // per round, at most
  int patience = 3;              // rounds without fewer folded faces, after which it gives up
  double over_relaxation = 1.5;  // of the sweeps: faces unfold sooner
};

struct UntangleResult {
  int folded_before = 0;
  std::vector<int> folded;  // faces that are still folded, in the numbering of the connectivity
  int sweeps = 0;
  bool interrupted = false;
};

/// Unfolds faces whose alignment with the surface is below the guards' threshold, as far as possible.
UntangleResult untangle(Relaxation& relaxation, const UntangleOptions& options, const Observer& observer);

}  // namespace hooke
