// Isosurfaces: the surfaces that marching cubes make of images and of other values on a grid.
#pragma once

#include <vector>

#include "hooke/mesh/adjacency.h"

namespace hooke {

/// Did marching cubes make the mesh, of values on a grid along the axes, and is the target length about that
/// of its edges or shorter? Nearly all faces lie in one cell of the grid each, and nearly all vertices on
/// edges of cells, many of them between the ends. Where the surface that is meant has an edge, such a mesh
/// has a bevel as wide as a cell. `vertex_length`: target length at each vertex. W. E. Lorensen and H. E.
/// Cline, "Marching cubes", 1987.
bool is_isosurface(const Mat3X& points, const Adjacency& adjacency, const std::vector<double>& vertex_length);

}  // namespace hooke
