// Where a result is off by much of a wall of the input, as coarse edges at a bend of a thin sheet, or of a
// gap.
#pragma once

#include <vector>

#include "hooke/core/types.h"

namespace hooke {

class AttemptMaker;
struct Attempt;

/// A place that the result has left: through the centre of a face of the input, along its longest edge.
/// Lengths are in the unit of the points.
struct LeftWall {
  Vec3 from, to;
  double distance;       // of the centre from the result, across the face
  double thickness = 0;  // to the other side of the wall or gap
  double target;         // length there
};

/// Those where the distance is more than `share` of the thickness, in the order of the faces.
/// The other side is a face that lies the other way to within 30 degrees, straight above or below. None for
/// walls thinner than 1e-4 of the diagonal.
std::vector<LeftWall> left_walls(const AttemptMaker& maker, const Attempt& attempt, double share);

/// Notes in the result those of more than a quarter of the thickness, where the facets of the input are
/// meant.
void note_walls(const AttemptMaker& maker, Attempt& attempt);

}  // namespace hooke
