// Adjacency mode `flip`: the same vertices, joined by better triangles. Flow first, springs second, polish
// last: springs with flips alone lock at edges that vary by 13-18 %.
// Vertices keep their ids, but travel: by one or two edge lengths, and more on uneven meshes.
#pragma once

#include "hooke/connectivity/edge_flips.h"
#include "hooke/connectivity/lloyd_flow.h"
#include "hooke/connectivity/valence_flips.h"
#include "hooke/integrator/angle_springs.h"
#include "hooke/integrator/lbfgs.h"
#include "hooke/integrator/untangle.h"

namespace hooke {

struct Workspace;

enum class ConnectivityMode {
  fixed,  // the faces stay
  flip,   // edges are flipped
  adapt,  // they are split and collapsed too: other vertices and faces
};

/// How long to go on for better triangles.
enum class Effort { fast, standard, thorough };

struct FlipOptions {
  LloydFlowOptions flow;
  int spring_rounds = 8;        // of springs and Delaunay flips after the flow, at most ...
  double few_flips = 1e-3;      // ... while more than this part of the edges flips
  int spring_steps = 15;        // evaluations of the springs' energy per round
  double guard_limited = 2e-3;  // part of the vertices; if guards hold back more in a step, sweeps go first
  FlipPassOptions passes;
  double energy_drop = 2e-3;  // see IntegrationOptions; of the relaxation that follows
  FlipGuardOptions guard;
  /// Starts where the springs end and goes on as long as it helps; angles pay for a little of the edges.
  AngleSpringOptions angle_springs{
      .first_threshold = 0, .margin = 3, .last_threshold = 60, .rest = 3e-3, .edge_error_limit = 1.05};
};

/// The options that an effort stands for.
FlipOptions flip_options(Effort effort);

struct FlipResult {
  UntangleResult untangle;
  LloydFlowResult flow;
  int spring_rounds = 0;
  long long flips = 0;  // in all
  int passes = 0;
  int evaluations = 0;                    // of the energy
  double max_travel = 0, rms_travel = 0;  // from input to result, in target lengths
  bool interrupted = false;
};

/// Moves the vertices of the work on the surface of the input and flips edges between. Boundary edges stay.
/// Pre-condition: no refit() yet.
FlipResult flip_connectivity(Workspace& work, const FlipOptions& options, const EnergyTerms& terms,
                             const GuardOptions& guards, double corner_angle, const Observer& observer);

/// How far the vertices are from where they started, in target lengths. Pre-condition: they are the same.
void measure_travel(const Workspace& work, FlipResult& result);

}  // namespace hooke
