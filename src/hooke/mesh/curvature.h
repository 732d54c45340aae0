// Discrete curvatures of a triangle mesh.
// M. Meyer, M. Desbrun, P. Schroeder, A. H. Barr, "Discrete differential-geometry operators for triangulated
// 2-manifolds", 2003.
#pragma once

#include <vector>

#include "hooke/mesh/adjacency.h"

namespace hooke {

/// NaN where a curvature is not defined: on the boundary, at isolated vertices, beside faces without area.
struct VertexCurvature {
  std::vector<double> mean;      // 1/length, unsigned: half the length of the mean curvature normal
  std::vector<double> gaussian;  // 1/length^2: angle defect over the mixed area
};

VertexCurvature measure_curvature(const Mat3X& points, const Adjacency& adjacency);

// Principal curvatures by fitting a quadric to the vertices about each vertex. It asks that the vertices lie
// on the surface, not that the triangles are good. F. Cazals, M. Pouget, "Estimating differential quantities
// using polynomial fitting of osculating jets", 2005.

/// The largest principal curvature by size at each vertex, 1/length; 0 at a vertex without faces. Fits two
/// rings, and a third where they have fewer than ten vertices. Those turned away by more than 78 degrees (on
/// the other side of a thin sheet) do not count, unless too few are left.
std::vector<double> largest_curvatures(const Mat3X& points, const Adjacency& adjacency);

}  // namespace hooke
