// The corners of quadrilaterals and polygons, whose shape their triangles do not show: two equilateral
// triangles make a rhombus.
#pragma once

#include <optional>
#include <vector>

#include "hooke/core/lists.h"
#include "hooke/core/types.h"

namespace hooke {

/// Angles at the corners of polygons with more than three, degrees; above 180 where a corner is concave, seen
/// from the side of the polygon's Newell normal.
struct PolygonAngles {
  double min = 0;
  double max = 0;
  /// Root mean square of the differences from the angle of a regular polygon with as many corners, 90 of a
  /// quadrilateral.
  double rms_deviation = 0;
};

/// Of the polygons, given by their vertices; empty if none has more than three corners. A corner at which an
/// edge has no length has angle zero.
std::optional<PolygonAngles> measure_polygon_angles(const Mat3X& points, const IntLists& polygons);

/// The vertices, ascending, of polygons whose own deviation is greater than with the points `before`, by more
/// than `margin` degrees.
std::vector<int> vertices_of_worse_polygons(const Mat3X& points, const Mat3X& before,
                                            const IntLists& polygons, double margin);

}  // namespace hooke
