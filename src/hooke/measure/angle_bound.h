// What the connectivity allows: how large the least angle about a face can become when only vertices move.
#pragma once

#include "hooke/mesh/connectivity.h"

namespace hooke {

/// An upper bound of the least angle and what sets it.
struct AngleBound {
  double degrees = 60;
  std::vector<int> vertices;  // whose number of faces sets the bound, ascending; empty at 60 degrees
};

/// The largest t for which the faces within `rings` rings about the face can have angles of at least t that
/// sum to 180 degrees in each face and, at each vertex, to what they sum to now: 360 degrees less the
/// curvature inside, the measured angle on the boundary. Where the surface and the boundary stay as they are
/// no movement gets beyond it; the geometry may allow less. 60 degrees where the coordinates are too large
/// for the angles to be measured.
AngleBound bound_least_angle(const Mat3X& points, const Connectivity& connectivity, int face, int rings = 2);

}  // namespace hooke
