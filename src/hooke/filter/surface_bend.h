// How a surface bends about the vertices of a mesh on it, from their normals.
#pragma once

#include "hooke/core/symmetric_matrix.h"
#include "hooke/mesh/connectivity.h"

namespace hooke {

/// A step d along the surface turns its unit normal n by S d and leads to x + d - (d . S d / 2) n, to second
/// order.
struct SurfaceBend {
  SymmetricMatrix shape = {};  // S: the shape operator for outward normals, 1 / length; 1 / R on a sphere
  float change = 0;  // of S from a vertex to the next along the way, rms; the greatest within a ring
};

/// It may bend in any way: its change is infinite.
SurfaceBend unknown_bend();

/// S in the sense of least squares over the edges about each vertex; unknown where they do not span a plane.
std::vector<SurfaceBend> surface_bends(const Mat3X& points, const Mat3X& normals,
                                       const Connectivity& connectivity);

}  // namespace hooke
