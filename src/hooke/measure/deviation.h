// The distance from one surface to another, sampled.
#pragma once

#include <cstddef>
#include <optional>

#include "hooke/core/stopwatch.h"
#include "hooke/measure/measured_surface.h"

namespace hooke {

struct MaxRms {
  double max = 0;
  double rms = 0;
};

/// Where a point is closest to a surface.
struct ClosestFacePoint {
  Vec3 point = Vec3::Zero();
  long long place = -1;  // of its face in the tree's faces(); -1 where there is none
};

/// Greatest distance to the surface `to` of ten samples a face, and the root of the mean square over the area
/// of `from`. The samples are the corners, the edge midpoints and the centres of the four triangles between
/// them. Infinite when `to` has no faces. `centres`, where given, gets the closest points of the faces'
/// centres, in the order of from.tree.faces().
MaxRms measure_distance(const MeasuredSurface& from, const MeasuredSurface& to,
                        std::vector<ClosestFacePoint>* centres = nullptr);

// How far a result has gone from the mesh it was made from.

/// UniformVector are in file units, angles in degrees. Distances are sampled at ten points a face: its
/// corners, its edge midpoints, and the centres of the four triangles between them. A max is attained at a
/// sample and so is a lower bound of the Hausdorff distance; an rms is an integral over the area. Infinite
/// when the other side is empty.
struct Deviation {
  std::optional<MaxRms> displacement;  // of the vertices; none when their numbers differ
  MaxRms to_reference;                 // from the result's surface to the closest point of the reference
  MaxRms from_reference;               // from the reference's surface to the closest point of the result
  double diagonal = 0;                 // of the reference's box

  /// Between the normal of a result face and that of the reference face closest to its centre; rms over the
  /// area.
  MaxRms normal_deviation;
  /// Faces whose normal opposes the reference's vertex normals, interpolated at the point closest to the
  /// centre.
  std::size_t flipped_faces = 0;
  /// Ids, ascending, of these, and of faces whose normal opposes that of the reference face closest to their
  /// centre: they lie at folds of the reference itself.
  std::vector<int> opposing_faces;

  std::optional<double> area_change;    // result / reference - 1
  std::optional<double> volume_change;  // result / reference - 1; none unless both are closed

  // Greatest distance between the boundary polylines, 8 samples an edge; none unless both have a boundary.
  std::optional<double> boundary_to_reference;
  std::optional<double> boundary_from_reference;
};

/// The two may differ in connectivity. Faces with equal ids are looked at first, so that it is fastest when
/// they lie close to each other.
Deviation measure_deviation(const MeasuredSurface& reference, const MeasuredSurface& result,
                            Stopwatch* stopwatch = nullptr);
Deviation measure_deviation(const Mat3X& reference_points, const Adjacency& reference,
                            const Mat3X& result_points, const Adjacency& result);

}  // namespace hooke
