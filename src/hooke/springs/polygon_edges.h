// Springs of triangulated quadrilaterals that are to be squares: the diagonal that cuts one into triangles is
// longer than its sides, or springs would make a rhombus of each square.
#pragma once

#include <vector>

#include "hooke/core/lists.h"
#include "hooke/mesh/mesh.h"

namespace hooke {

/// Rest lengths over target lengths of the edges of a mesh, by edge of the adjacency, for `e:rest_ratio`: q
/// of most edges, q sqrt(2) of the diagonals of quadrilaterals. With q such squares, and equilateral
/// triangles of all else, cover as much as equilateral triangles, as many as there are, of the target length:
/// .93 for quadrilaterals alone. `polygons`: the vertex ids of each; their triangles are the faces of the
/// mesh, in this order. Throws Error if those are not as many.
std::vector<double> rest_ratios(const IntLists& polygons, const MemoryOrder& memory_order);

}  // namespace hooke
