// Where a surface passes through itself.
#pragma once

#include "hooke/geometry/aabb_tree.h"

namespace hooke {

/// Do two triangles without a common vertex id share a point? Touching counts. Exact.
/// Pre-condition: both have an area.
bool triangles_meet(const std::array<Vec3, 3>& s, const std::array<Vec3, 3>& t);

/// All pairs of faces (f < g, ascending) that share a point beyond what their common vertices make them
/// share: any point when they have no common vertex, a point besides the vertex or the edge otherwise
/// (overlap in a plane included). Two faces with the same three vertices are no such pair. Exact; vertices
/// with equal places but different ids count as different. Faces without area (exactly collinear) are left
/// out: they are counted as degenerate.
std::vector<std::array<int, 2>> find_self_intersections(const AabbTree& tree);
std::vector<std::array<int, 2>> find_self_intersections(const Mat3X& points,
                                                        const std::vector<Triangle>& faces);

}  // namespace hooke
