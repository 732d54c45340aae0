// How far a result has gone from the mesh it was made from.
#pragma once

#include <cstddef>
#include <optional>

#include "hooke/core/stopwatch.h"
#include "hooke/measure/surface_distance.h"

namespace hooke {

/// Lengths are in file units, angles in degrees. Distances are sampled at ten points a face: its corners, its
/// edge midpoints, and the centres of the four triangles between them. A max is attained at a sample and so
/// is a lower bound of the Hausdorff distance; an rms is an integral over the area. Infinite when the other
/// side is empty.
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
Deviation measure_deviation(const Mat3X& reference_points, const Connectivity& reference,
                            const Mat3X& result_points, const Connectivity& result);

}  // namespace hooke
