// Flow: over-relaxed Lloyd steps between Delaunay flips. It carries the vertices to where a regular mesh has
// them; springs with flips alone lock long before.
#pragma once

#include "hooke/connectivity/corner_rule.h"
#include "hooke/connectivity/lloyd.h"
#include "hooke/integrator/guards.h"
#include "hooke/integrator/integrator.h"

namespace hooke {

struct FlowOptions {
  int rounds = 32;       // of flips and one step
  int corner_every = 5;  // rounds between two looks at the corners, after the first quarter of the rounds
  LloydOptions lloyd{};
};

struct FlowResult {
  int rounds = 0;
  long long flips = 0;
  long long held_back = 0;  // vertex steps shortened by the guards
  bool interrupted = false;
};

/// Ends with flips: the mesh is Delaunay as far as the guards allow. The observer is asked beforehand, and
/// after each round.
FlowResult flow(FlippingMesh& mesh, const FlowOptions& options, const FlipGuardOptions& flip_guard,
                const GuardOptions& guards, const Observer& observer);

}  // namespace hooke
