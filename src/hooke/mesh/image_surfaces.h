// Surfaces that were made of images. The steps of binary masks, such as labels of medical images, and the
// bevels that marching cubes make are those of the image, and no sharp edges of the shape.
#pragma once

#include <vector>

#include "hooke/mesh/adjacency.h"

namespace hooke {

/// Is the mesh made of a binary mask by marching cubes or tetrahedra, and does the target length not resolve
/// its steps? Nearly all edges of each component, below 1.5 target lengths on the average, lead from a point
/// of a lattice to one close by, in a few ways, the faces have more orientations than those of blocks and
/// look all ways, as around a body, and a third of the vertices on sharp edges are corners. `vertex_length`:
/// target length at each vertex.
bool is_marched_mask(const Mat3X& points, const Adjacency& adjacency,
                     const std::vector<double>& vertex_length);

/// Is the mesh the surface of a binary mask whose steps the target length does not resolve? Either
/// is_marched_mask(), or the sharp edges, those above 45 degrees, are of three directions with a length each
/// below .75 target lengths, as around blocks, and a third of their vertices are corners, so that it is not
/// merely a regular mesh of a box.
bool is_staircase(const Mat3X& points, const Adjacency& adjacency, const std::vector<double>& vertex_length);

/// Did marching cubes make the mesh, of values on a grid along the axes, and is the target length about that
/// of its edges or shorter? Nearly all faces lie in one cell of the grid each, and nearly all vertices on
/// edges of cells, many of them between the ends. Where the surface that is meant has an edge, such a mesh
/// has a bevel as wide as a cell. `vertex_length`: target length at each vertex. W. E. Lorensen and H. E.
/// Cline, "Marching cubes", 1987.
bool is_isosurface(const Mat3X& points, const Adjacency& adjacency, const std::vector<double>& vertex_length);

/// The points with the steps smoothed, except for those that are held; the volume is about kept, and
/// components so small that it would not be stay as they are.
/// G. Taubin, "A signal processing approach to fair surface design", 1995.
Mat3X without_steps(Mat3X points, const Adjacency& adjacency, const std::vector<char>& is_held);

}  // namespace hooke
