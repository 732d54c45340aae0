// Closest points of a surface's faces, for points that are tracked near one of its vertices. Those of any
// point: bounding_volume_tree.h.
#pragma once

#include "hooke/core/types.h"
#include "hooke/filter/surface.h"
#include "hooke/mesh/connectivity.h"

namespace hooke {

/// Refers to the mesh: cheap to make, and must not outlive it.
struct NearFaces {
  const Mat3X& points;
  const Mat3X& normals;  // unit, of the vertices
  const Connectivity& connectivity;

  /// Walks from the vertex over edges while that brings it closer to x: steepest descent of the distance.
  int nearest_vertex(const Vec3& x, int vertex) const;

  /// Has a face at the anchor a point within the distance? No more than that: others may be closer.
  bool has_face_within(const Vec3& x, int anchor, double distance) const;

  /// Closest point of the faces about the anchor and about its neighbours, from where it walks on while that
  /// brings it closer. Its normal is blended from those of the corners, its anchor the nearest corner. x
  /// itself, normal zero and no_cover where the anchor has no faces.
  Foot closest_point(const Vec3& x, int anchor) const;

 private:
  Foot closest_point_of_ring(const Vec3& x, int anchor) const;
};

}  // namespace hooke
