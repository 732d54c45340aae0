// Edge flips that give each corner of the boundary and of creases as many faces as fit its angle. Delaunay
// flips alone divide a corner of 42 degrees into two angles of 21, which vertex motion cannot improve.
#pragma once

#include "hooke/connectivity/edge_flips.h"

namespace hooke {

/// Flips edges at corners whose valence differs from the target, see corner_valences(). Where a flip is not
/// allowed it first gives an inner neighbour of valence three a fourth edge, else moves the neighbour away
/// from the corner, else slides the corner's neighbours on the feature edges toward it. Moves that enable no
/// flip are reverted. Returns the number of flips.
int flip_corners_to_valence(FlippableMesh& mesh, const FlipGuardOptions& options);

}  // namespace hooke
