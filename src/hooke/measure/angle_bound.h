// What the connectivity allows: how large the least angle about a face can become when only vertices move.
#pragma once

#include "hooke/measure/measured_surface.h"
#include "hooke/mesh/adjacency.h"

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
AngleBound bound_least_angle(const Mat3X& points, const Adjacency& adjacency, int face, int rings = 2);

/// The same where creases, edges of the surface's ids, part the faces about a vertex and stay: what the
/// angles sum to stays as it is in each sector of a vertex on its own. The vertices are the surface's ids.
std::vector<AngleBound> bound_least_angles(const MeasuredSurface& surface, const std::vector<int>& faces,
                                           const std::vector<Edge>& creases);

}  // namespace hooke
