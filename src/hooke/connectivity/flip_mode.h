// Connectivity mode `flip`: the same vertices, joined by better triangles. Lloyd flow comes first, then
// springs with flips, then angle springs; springs with flips alone stall at edge lengths that vary by 13-18
// %. Vertices keep their ids but travel by one or two edge lengths, and farther on uneven meshes.
#pragma once

#include "hooke/connectivity/connectivity_mode.h"
#include "hooke/connectivity/lloyd_flow.h"
#include "hooke/connectivity/valence_flips.h"
#include "hooke/integrator/angle_springs.h"
#include "hooke/integrator/lbfgs.h"

namespace hooke {

struct Workspace;

struct FlipOptions {
  int flow_rounds = 32;     // of Lloyd flow, before springs and flips
  int spring_rounds = 8;    // maximum rounds of springs and Delaunay flips after the flow
  double few_flips = 1e-3;  // share of the edges; the rounds end when no more than this are flipped
  int spring_steps = 15;    // evaluations of the spring energy per round
  FlipPassOptions passes;
  double energy_drop = 2e-3;  // see IntegrationOptions; of the relaxation that follows
  /// Angle springs start at the present minimum angle and go on as long as they raise it; edge lengths may
  /// become a little less uniform for it.
  AngleSpringOptions angle_springs{
      .first_threshold = 0, .margin = 3, .last_threshold = 60, .rest = 3e-3, .edge_error_limit = 1.05};
};

/// Moves the vertices of the workspace on the surface of the input, alternating with edge flips. Feature
/// edges stay. Pre-condition: no Workspace::refit() yet.
FlipResult run_flip_mode(Workspace& work, const FlipOptions& options, const EnergyTerms& terms,
                         const ShapeLimits& limits, const Observer& observer);

/// Sets max_travel and rms_travel: the distances of the vertices from their input positions, in target
/// lengths. Pre-condition: the vertices are those of the input.
void measure_travel(const Workspace& work, FlipResult& result);

}  // namespace hooke
