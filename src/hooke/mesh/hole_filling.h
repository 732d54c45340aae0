// Triangles over a hole.
// Source: G. Barequet, M. Sharir, "Filling gaps in the boundary of a polyhedron", Computer Aided Geometric
// Design 12 (1995): the triangulation of least area, by dynamic programming.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "hooke/core/types.h"

namespace hooke {

/// Whether there is an edge between two vertices already.
using HasEdge = std::function<bool(int, int)>;

/// The triangulation of a closed polygon without new vertices: least area, with some weight on short
/// diagonals, which decides on planes. Its triangles have the orientation of the polygon. No diagonal is an
/// edge that is there already; none if that is impossible. Time grows with the third power of the number of
/// vertices. Pre-condition: at least three different vertices.
std::optional<std::vector<Triangle>> fill_polygon(const Mat3X& points, const std::vector<int>& polygon,
                                                  const HasEdge& has_edge);

}  // namespace hooke
