// Planes that mirror a mesh onto itself, as those of characters and parts do that are modelled in halves.
#pragma once

#include <vector>

#include "hooke/core/lists.h"
#include "hooke/core/types.h"

namespace hooke {

/// A plane across a coordinate axis.
struct Mirror {
  int axis;
  double plane;            // coordinate, in the unit of the points
  std::vector<int> image;  // of each vertex; itself in the plane

  Vec3 operator()(Vec3 x) const {
    x[axis] = 2 * plane - x[axis];
    return x;
  }
};

/// Of the distance between places that mirror each other, in diagonals of the box of the points.
inline constexpr double mirror_tolerance = 1e-6;

/// The planes through the middle of the box of the points (3 x |V|) that mirror each vertex to the place of
/// another, or its own, within mirror_tolerance, and each polygon to another. None if vertices share
/// their places.
std::vector<Mirror> find_mirrors(const Mat3X& points, const IntLists& polygons);
std::vector<Mirror> find_mirrors(const Mat3X& points, const std::vector<Triangle>& faces);

}  // namespace hooke
