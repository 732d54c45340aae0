// Edges without length, as of marching cubes where a value at a grid point is that of the level, and of cuts
// that miss a vertex by a rounding.
#pragma once

#include <vector>

#include "hooke/core/types.h"

namespace hooke {

struct TinyEdges {
  std::vector<Edge> collapsed;      // the vertex that stays, which has the smaller id, and the one that goes
  std::vector<int> into;            // of each vertex, the one that it is now
  std::vector<int> removed;         // faces, ascending
  std::vector<Triangle> triangles;  // all, of which the removed ones are of no use
};

/// Collapses edges of no more than the length `longest`, by which no vertex moves farther; those with some
/// length only if they are of rounding, beside others, and turn no face over. None between the two sides of a
/// foil, where the topology would change, or if the triangles are no oriented manifold.
TinyEdges collapse_tiny_edges(const Mat3X& points, const std::vector<Triangle>& triangles, double longest);

}  // namespace hooke
