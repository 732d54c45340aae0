// Flat patches of a smooth surface, as opposed to the facets of a part. Where a function is a sum of
// functions of each coordinate, as that of a sphere or of many lattices is, marching tetrahedra make a flat
// polygon in each cell of the grid.
#pragma once

#include <vector>

#include "hooke/mesh/adjacency.h"

namespace hooke {

/// The target lengths beyond which a patch is resolved, and so is a facet.
constexpr double longest_patch = 4;

/// Marks the faces of flat patches that are part of a smooth surface: connected over `flat` edges, of two
/// faces or more, no longer than `longest_patch`, and without a `sharp` edge. None unless there are many of
/// more than two faces: quadrilaterals alone may be facets of a part. `flat` and `sharp` are marks by edge,
/// `vertex_length` is the target length at each vertex.
std::vector<char> faces_in_smooth_patches(const Mat3X& points, const Adjacency& adjacency,
                                          const std::vector<char>& flat, const std::vector<char>& sharp,
                                          const std::vector<double>& vertex_length);

}  // namespace hooke
