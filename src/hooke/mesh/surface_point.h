// A point on a mesh given by a face and barycentric weights, which maps values from one mesh to another.
#pragma once

#include "hooke/geometry/triangle.h"
#include "hooke/mesh/adjacency.h"

namespace hooke {

struct SurfacePoint {
  int face = -1;                // -1: on no face, for an isolated vertex
  Vec3 weights = Vec3::Zero();  // barycentric, of the face's corners in their order; none negative, sum 1
};

/// The position of a vertex of the result on the mesh it was made from.
struct MapEntry {
  int vertex = -1;        // its id in that mesh; -1 for a new vertex
  SurfacePoint position;  // on the faces of that mesh
};

/// The place of a point of a face. Pre-condition: the point has a face.
SurfacePoint on_face(const ClosestPoint& point, const Mat3X& points, const Adjacency& adjacency);

/// The corner of its face that has the largest weight. Pre-condition: it is on a face.
int nearest_corner(const SurfacePoint& place, const Adjacency& adjacency);

/// The closest point to x on the faces at `hint`, a vertex nearby, and at its neighbours but hubs of very
/// many faces; the search moves on to the nearest corner while that gets closer to x. From such a hub it
/// finds its way to faces nearby, not necessarily the closest. The point `known` if none is closer than that;
/// without, face -1 if none is there, or x is not finite.
ClosestPoint closest_point_nearby(const Mat3X& points, const Adjacency& adjacency, const Vec3& x, int hint,
                                  const ClosestPoint& known = {});

/// Its place on the mesh; face -1 if there is none.
SurfacePoint locate(const Mat3X& points, const Adjacency& adjacency, const Vec3& x, int hint);

}  // namespace hooke
