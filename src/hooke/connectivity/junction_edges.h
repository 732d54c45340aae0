// The edges of junctions (see mesh/junctions.h) in mode `adapt`: split and joined in all sheets at once, so
// that these stay joined.
#pragma once

#include "hooke/connectivity/edge_collapses.h"
#include "hooke/connectivity/face_count.h"

namespace hooke {

/// Present and target number of edges of each curve of the junctions, see target_edge_count().
CurveEdges count_junction_edges(const WorkingMesh& mesh, double chord_error);

/// Splits edges of junctions until none is too long in one of its sheets, and the longest ones of curves with
/// fewer edges than their target; then collapses the shortest ones of curves with more. New vertices lie on
/// their curve. A collapse must be allowed in each sheet, and keep the topology of the joined mesh. No other
/// function splits or collapses these edges. Leaves ids unused.
CountChanges match_junction_edges(WorkingMesh& mesh, double chord_error,
                                  const CollapseOptions& collapse = {});

}  // namespace hooke
