// Unfolds faces that lie folded away from the surface, before the springs act: springs on unsigned altitudes
// would push such faces the wrong way, so a spring on their signed area unfolds them first.
#pragma once

#include "hooke/core/types.h"
#include "hooke/integrator/integration.h"

namespace hooke {

struct Relaxation;

struct UntangleOptions {
  int rounds = 12;  // maximal number; each covers more rings than the one before
  static constexpr int first_rings =
      2;  // around the folded faces, within which vertices move in the first round
  static constexpr int more_rings = 2;  // added in each round
  int sweeps = 30;                      // maximal number per round
  static constexpr int patience = 3;    // rounds without fewer folded faces before giving up
  double over_relaxation = 1.5;         // of the sweeps: faces unfold sooner
};

struct UntangleResult {
  int folded_before = 0;
  std::vector<int> folded;  // ids in the adjacency of the faces that are still folded
  int sweeps = 0;
  bool interrupted = false;
};

/// Unfolds, as far as possible, the faces whose alignment with the surface is below the guards' limit.
UntangleResult untangle(Relaxation& relaxation, const UntangleOptions& options, const Observer& observer);

}  // namespace hooke
