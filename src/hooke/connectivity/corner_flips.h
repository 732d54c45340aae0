// Edge flips that give each corner of the boundary and of creases as many faces as fit its angle. Delaunay
// flips alone divide a corner of 42 degrees into two angles of 21, which vertex motion cannot improve.
#pragma once

#include "hooke/connectivity/edge_flips.h"

namespace hooke {

/// Flips edges at corners whose valence differs from the target, see corner_valences(). Where a flip is not
/// allowed it first gives an inner neighbour of valence three a fourth edge, else moves the neighbour away
/// from the corner; a move that enables no flip is reverted. Without these two, 13 and 4 of 56 graphs over a
/// square end in mode `flip` at 22-26 degrees instead of 42-47. Returns the number of flips.
int flip_corners_to_valence(WorkingMesh& mesh);

}  // namespace hooke
