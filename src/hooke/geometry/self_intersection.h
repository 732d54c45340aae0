// Exact tests for intersections of triangles and self-intersections of a mesh.
#pragma once

#include "hooke/geometry/aabb_tree.h"

namespace hooke {

/// Whether two triangles without a common vertex id share a point; touching counts. Exact.
/// Pre-condition: both have a positive area.
bool triangles_meet(const std::array<Vec3, 3>& s, const std::array<Vec3, 3>& t);

/// The ends of the segment in which two triangles that meet cross, up to rounding; twice a point of both
/// where they lie in one plane, or only touch.
std::array<Vec3, 2> crossing_segment(const std::array<Vec3, 3>& s, const std::array<Vec3, 3>& t);

/// All pairs of faces (f < g, ascending) that intersect beyond their common vertices: in any point if they
/// have no common vertex, otherwise in a point besides the common vertex or edge (overlap in a plane
/// included). Two faces with the same three vertices are not reported. Exact; vertices with equal positions
/// but different ids count as different. Faces without area (exactly collinear) are skipped: they are counted
/// as degenerate.
std::vector<std::array<int, 2>> find_self_intersections(const AabbTree& tree);
std::vector<std::array<int, 2>> find_self_intersections(const Mat3X& points,
                                                        const std::vector<Triangle>& faces);

}  // namespace hooke
