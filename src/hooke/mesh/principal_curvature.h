// Principal curvatures by fitting a quadric to the vertices about each vertex. It asks that the vertices lie
// on the surface, not that the triangles are good. F. Cazals, M. Pouget, "Estimating differential quantities
// using polynomial fitting of osculating jets", 2005.
#pragma once

#include "hooke/mesh/connectivity.h"

namespace hooke {

/// The largest principal curvature by size at each vertex, 1/length; 0 at a vertex without faces. Fits two
/// rings, and a third where they have fewer than ten vertices. Those turned away by more than 78 degrees (on
/// the other side of a thin sheet) do not count, unless too few are left.
std::vector<double> largest_curvatures(const Mat3X& points, const Connectivity& connectivity);

}  // namespace hooke
