// Corners of the boundary and of creases: as many faces as fit their angle. Delaunay flips alone cut a corner
// of 42 degrees into two of 21, which no motion mends.
#pragma once

#include "hooke/connectivity/edge_flips.h"

namespace hooke {

/// Flips edges at the corners that do not have the valence they want. Where a flip is not allowed it makes
/// room: it gives an inner neighbour with three edges a fourth, else pushes the neighbour away from the
/// corner, else slides the corner's neighbours on the boundary toward it. What brings nothing is undone.
/// Returns the number of flips.
int flip_corners_to_valence(FlippableMesh& mesh, const FlipGuardOptions& options);

}  // namespace hooke
