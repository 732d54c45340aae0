// Connectivity mode `adapt`: edges are split and collapsed too, until there are as many faces of the target
// length as the surface takes. What follows is that of mode `flip`: see flip_connectivity.h.
// After M. Botsch and L. Kobbelt, "A remeshing approach to multiresolution modeling", 2004.
#pragma once

#include "hooke/count_control.h"
#include "hooke/face_collapses.h"
#include "hooke/flip_connectivity.h"
#include "hooke/flow.h"
#include "hooke/untangle.h"
#include "hooke/workspace.h"

namespace hooke {

struct AdaptOptions {
  int rounds = 5;           // of splits, collapses and flow
  int first_flow = 6;       // rounds of flow before: what can stay where it spreads out need not go
  int flow_rounds = 6;      // after the splits and collapses of a round
  int count_rounds = 30;    // of count control and flow, at most
  int count_flow = 6;       // rounds of flow after a round of count control
  double count_slack = 2;   // faces by which the count may miss what is wanted
  double chord_error = .1;  // greatest distance of a curve from its edges, in target lengths
  double keep_bends = 1.3;  // a curve keeps its bends if its edges and those it wants differ by less
  SplitOptions split;
  CollapseOptions collapse;
  CountOptions count;
  CollapseOptions folded = folded_face_options();
};

/// The options that an effort stands for.
AdaptOptions adapt_options(Effort effort);

struct AdaptResult {
  UntangleResult untangle;
  int rounds = 0;
  int count_rounds = 0;
  long long splits = 0, collapses = 0, flips = 0;
  double wanted_faces = 0;
  bool interrupted = false;
};

/// Replaces the mesh of the work. Boundary loops, creases, corners and fixed vertices are kept, as is the
/// topology. Pre-condition: no refit() yet.
AdaptResult adapt(Workspace& work, const AdaptOptions& options, const FlipGuardOptions& flip_guard,
                  const EnergyTerms& terms, const GuardOptions& guards, double corner_angle,
                  const Observer& observer);

}  // namespace hooke
