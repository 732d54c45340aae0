// Boundaries that lie on each other: a surface that is cut open, along a seam of its texture for instance.
#pragma once

#include <vector>

#include "hooke/mesh/connectivity.h"

namespace hooke {

/// Ids, ascending, of boundary vertices that have exactly the coordinates of another boundary vertex.
std::vector<int> coincident_boundary_vertices(const Mat3X& points, const Connectivity& connectivity);

}  // namespace hooke
