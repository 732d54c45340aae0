// Flat patches of a smooth surface, as opposed to the facets of a part. Where a function is a sum of
// functions of each coordinate, as that of a sphere or of many lattices is, marching tetrahedra make a flat
// polygon in each cell of the grid; and where coordinates have few digits, as the heights of a terrain in
// whole metres, neighbours lie in a plane by chance.
#pragma once

#include <vector>

#include "hooke/mesh/adjacency.h"

namespace hooke {

/// Marks the faces of flat patches that are part of a smooth surface: connected over `flat` edges, of two
/// faces or more, and without a `sharp` edge; with others next to them that are many, of more than two faces,
/// for quadrilaterals may be facets, and of all sizes, as a grid cuts them and nobody designs them; or with
/// many next to them at edges that turn by no more than the rounding of coordinates may have made, where
/// these take many values and few such edges lie in straight lines of the same turn, as creases do. Far
/// larger ones among these are flat sides. `flat` and `sharp` are marks by edge.
std::vector<char> faces_in_smooth_patches(const Mat3X& points, const Adjacency& adjacency,
                                          const std::vector<char>& flat, const std::vector<char>& sharp);

}  // namespace hooke
