// A point on a mesh by face and weights: what carries values from one mesh to another.
#pragma once

#include "hooke/mesh/adjacency.h"

namespace hooke {

struct SurfacePoint {
  int face = -1;                // -1: on no face, for a vertex that has none
  Vec3 weights = Vec3::Zero();  // barycentric, of the face's corners in their order; none negative, sum 1
};

/// Where a vertex of the result lies on the mesh it was made from.
struct MapEntry {
  int vertex = -1;     // the vertex there that it was; -1 for a new one
  SurfacePoint place;  // on the faces there
};

/// The closest point to x of the faces about `hint`, a vertex that is near, and of those it meets when it
/// walks on from there as long as that brings it closer.
SurfacePoint locate(const Mat3X& points, const Adjacency& adjacency, const Vec3& x, int hint);

}  // namespace hooke
