// Edge collapses: an edge that is too short becomes a vertex.
#pragma once

#include "hooke/collapse_trial.h"

namespace hooke {

/// Merges the ends of one edge and returns the vertex that stays, -1 where that is not allowed: see
/// try_collapse().
int collapse_edge(AdaptingMesh& mesh, int half_edge, const CollapseOptions& options);

/// Collapses edges until none is too short or no more may be: many at a time, the shortest first but for
/// those that come to be shorter meanwhile. Returns the number of collapses.
int collapse_short_edges(AdaptingMesh& mesh, const CollapseOptions& options);

}  // namespace hooke
