// Flaps: parts of a surface that lie back to back, so that nothing is between them.
#pragma once

#include <array>
#include <vector>

#include "hooke/core/types.h"

namespace hooke {

/// Groups of two faces and more with the same vertices; ascending, and the groups by their vertices.
std::vector<std::vector<int>> faces_of_same_vertices(const std::vector<Triangle>& triangles);

/// Those of two faces with opposite directions.
std::vector<std::array<int, 2>> faces_back_to_back(const std::vector<Triangle>& triangles,
                                                   const std::vector<std::vector<int>>& groups);

/// Of these pairs of faces with the same vertices and opposite directions the faces, ascending, that can be
/// dropped without an opening: each of their edges has no other face left, or two with different vertices.
/// Pairs that hang together but on no other face stay: they are a sheet with two sides. Pre-condition: a face
/// is in one pair at most.
std::vector<int> find_flaps(const std::vector<Triangle>& triangles,
                            const std::vector<std::array<int, 2>>& pairs);

}  // namespace hooke
