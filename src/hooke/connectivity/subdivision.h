// Subdivision: every face becomes four of half its size, whose new vertices are regular.
#pragma once

#include "hooke/connectivity/edge_splits.h"

namespace hooke {

/// Halves every edge, the new vertices on their curves or on the surface, and joins those of each face: one
/// step of C. Loop, "Smooth subdivision surfaces based on triangles", 1987, as far as who touches whom. An
/// edge that may not be split (see split_edge()) stays whole, and flips that the guard forbids are left out.
/// Target lengths stay as they are. Returns the number of splits. Pre-condition: no id is unused, and the
/// edges of the curves are counted.
int subdivide(AdaptingMesh& mesh, const SplitOptions& options, const FlipGuardOptions& flip_guard);

}  // namespace hooke
