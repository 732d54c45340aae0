// Edge collapses: an edge that is too short becomes a vertex.
#pragma once

#include "hooke/connectivity/collapse_trial.h"

namespace hooke {

/// Collapses edges until none is too short or no more may be: many at a time, the shortest first but for
/// those that come to be shorter meanwhile. Returns the number of collapses.
int collapse_short_edges(AdaptingMesh& mesh, const CollapseOptions& options);

}  // namespace hooke
