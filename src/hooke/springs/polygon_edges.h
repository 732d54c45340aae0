// Springs of triangulated polygons whose corners are to be those of regular polygons: the diagonals that cut
// a quadrilateral into triangles are longer than its sides, or springs would make a rhombus of each square.
#pragma once

#include <vector>

#include "hooke/core/lists.h"
#include "hooke/mesh/mesh.h"

namespace hooke {

/// Rest lengths over target lengths of the edges of a mesh, by edge of the adjacency, for `e:rest_ratio`.
/// Sides of polygons have ratio q, a diagonal across k of n sides q sin(k pi / n) / sin(pi / n), as in a
/// regular polygon; q is such that regular polygons cover as much as equilateral triangles, as many as there
/// are, of the target length: .93 for quadrilaterals alone. Polygons of more than six corners, which mostly
/// are facets, count as equilateral triangles. `polygons`: the vertex ids of each; their triangles are the
/// faces of the mesh, in this order. Throws Error if those are not as many.
std::vector<double> rest_ratios(const IntLists& polygons, const MemoryOrder& memory_order);

}  // namespace hooke
