// Solids that touch in edges and vertices, or share walls, taken apart.
#pragma once

#include <optional>
#include <vector>

#include "hooke/mesh/sheets.h"

namespace hooke {

/// Gives solids that touch vertices of their own where there is but one way to: where all faces that hang
/// together, over vertices, are those of closed solids that look outward, and alternate around each edge. Of
/// two faces back to back each is the wall of one solid. Other faces stay as they are, whatever is wrong with
/// them. In the order of make_sheets(); nothing is flipped or opened. None if there are no such solids.
/// Pre-condition: no face repeats another.
std::optional<Sheets> separate_touching_solids(const Mat3X& points, const std::vector<Triangle>& triangles);

/// The body of each face before faces are dropped: one of its faces, the same for all that hang together over
/// edges of two faces; -1 if they have a boundary, and for faces that use a vertex twice.
std::vector<int> closed_bodies(const std::vector<Triangle>& triangles);

}  // namespace hooke
