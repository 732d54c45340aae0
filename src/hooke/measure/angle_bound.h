// Upper bound of the smallest angle around a face when the connectivity is fixed and only vertices move.
#pragma once

#include "hooke/mesh/adjacency.h"

namespace hooke {

struct MeasuredSurface;

/// An upper bound of the smallest angle, and the vertices that determine it.
struct AngleBound {
  double degrees = 60;
  std::vector<int> vertices;  // their valences determine the bound; ascending; empty at 60 degrees
};

/// The largest t for which the faces within `rings` rings around the face can have angles of at least t that
/// sum to 180 degrees in each face and, at each vertex, to their current sum: 360 degrees minus the curvature
/// inside, the measured angle on the boundary. No motion that keeps the surface and the boundary exceeds it;
/// the geometry may allow less. 60 degrees if coordinates are too large to measure the angles.
AngleBound bound_min_angle(const Mat3X& points, const Adjacency& adjacency, int face, int rings = 2);

/// The same for several faces of a mesh with fixed creases, given as vertex pairs: the angle sum stays the
/// same in each wedge of a vertex. Faces and bounding vertices are ids of the surface, the ends of creases
/// vertices of its adjacency.
std::vector<AngleBound> bound_min_angles(const MeasuredSurface& surface, const std::vector<int>& faces,
                                         const std::vector<Edge>& creases);

}  // namespace hooke
