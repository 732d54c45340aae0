// Modes `flip` and `adapt`, last: slivers that are left are mended by other edges.
#pragma once

#include "hooke/connectivity/flip_connectivity.h"
#include "hooke/connectivity/sliver_trials.h"

namespace hooke {

struct MendOptions {
  int passes = 3;  // the vertices land after each, which may make slivers again
  SliverTrialOptions trials;
  double count_share = .02;  // of the wanted faces, by which their number may miss it in mode `adapt`
};

/// Changes the connectivity of the work about its slivers: in mode `flip` by flips only. Their neighbourhoods
/// settle; nothing else moves. Pre-condition: the vertices lie on the field of the input, see
/// Workspace::return_to_input().
SliverChanges mend_slivers(Workspace& work, ConnectivityMode mode, const EnergyTerms& terms,
                           const MendOptions& options, const GuardOptions& guards, double corner_angle,
                           const Observer& observer);

}  // namespace hooke
