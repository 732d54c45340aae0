// Deviation of a result from the mesh it was made from: sampled distances between the surfaces,
// displacements, normals and flipped faces.
#pragma once

#include <cstddef>
#include <optional>

#include "hooke/core/stopwatch.h"
#include "hooke/measure/measured_surface.h"

namespace hooke {

/// Maximum and root mean square.
struct MaxRms {
  double max = 0;
  double rms = 0;
};

/// The closest point of a surface to some point.
struct ClosestFacePoint {
  Vec3 point = Vec3::Zero();
  long long face_index = -1;  // index of its face in the tree's faces(); -1 without faces
};

/// The distance of each vertex from another surface, and the closest face there: by the indices of the
/// adjacencies. A vertex without faces has none: -1.
struct VertexDistances {
  std::vector<double> distances;
  std::vector<int> faces;
};

/// Maximum over ten samples per face of the distance to the surface `to`, and the root of the mean square
/// over the area of `from`. The samples are the corners, the edge midpoints and the centres of the four
/// triangles between them. Infinite if `to` has no faces. Also gives the distances of the
/// vertices; a non-null `centres` receives the closest points to the face centres, in the order of
/// from.tree.faces().
MaxRms measure_distance(const MeasuredSurface& from, const MeasuredSurface& to, VertexDistances& vertices,
                        std::vector<ClosestFacePoint>* centres = nullptr);

/// Lengths are in file units, angles in degrees. Distances are sampled at ten points per face, see
/// measure_distance(). A max is attained at a sample and so is a lower bound of the Hausdorff distance; an
/// rms is an integral over the area. Infinite if the other mesh is empty.
struct Deviation {
  std::optional<MaxRms> displacement;  // of the vertices; empty if their numbers differ
  MaxRms to_reference;                 // from the result's surface to the closest point of the reference
  MaxRms from_reference;               // from the reference's surface to the closest point of the result
  VertexDistances vertices_to_reference, vertices_from_reference;
  double diagonal = 0;  // of the reference's bounding box

  /// Between the normal of a result face and that of the reference face closest to its centre; rms over the
  /// area.
  MaxRms normal_deviation;
  /// Ids, ascending, of faces that are turned over: they oppose the closest face of the reference, and none
  /// that faces the same way is about as close, or is within a quarter of their longest edge where the face
  /// may have come nearer to another sheet: of another body, or of a wall thinner than the face is deep in a
  /// rounding, if a corner of it is on its own sheet and it has no fold with a neighbour but where the
  /// reference has one.
  std::vector<int> flipped_faces;
  /// Ids, ascending, of the flipped faces and of faces that oppose the closest face of the reference, which
  /// lie at folds of the reference itself, but on no face of it that faces the same way.
  std::vector<int> opposing_faces;
  /// Faces that look down where all of the reference look up, or to another side along a coordinate axis, by
  /// less than 60 degrees on average, as those of a terrain do.
  int overhangs = 0;

  std::optional<double> area_change;    // result / reference - 1
  std::optional<double> volume_change;  // result / reference - 1; empty unless both are closed

  /// Maximum distances between the boundary polylines, 8 samples per edge; empty unless both have a boundary.
  std::optional<double> boundary_to_reference;
  std::optional<double> boundary_from_reference;
};

/// The meshes may differ in connectivity.
Deviation measure_deviation(const MeasuredSurface& reference, const MeasuredSurface& result,
                            Stopwatch* stopwatch = nullptr);
Deviation measure_deviation(const Mat3X& reference_points, const Adjacency& reference,
                            const Mat3X& result_points, const Adjacency& result);

}  // namespace hooke
