// Staircases: the surfaces of binary masks, such as labels of medical images, whose steps are those of the
// image and no sharp edges of the shape.
#pragma once

#include <vector>

#include "hooke/mesh/adjacency.h"

namespace hooke {

/// Is the mesh the surface of a binary mask with steps below .75 target lengths: are its sharp edges, those
/// above 45 degrees, of three directions with a length each, and a third of their vertices corners, so that
/// it is not merely a regular mesh of a box? `vertex_length`: target length at each vertex.
bool is_staircase(const Mat3X& points, const Adjacency& adjacency, const std::vector<double>& vertex_length);

}  // namespace hooke
