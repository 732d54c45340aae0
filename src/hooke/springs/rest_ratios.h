// Rest ratios: rest lengths of edges over their target lengths, for springs of quadrilaterals, which are cut
// into triangles and are to be rectangles: a diagonal is longer than the sides, and opposite sides are as
// long as each other.
#pragma once

#include <cstddef>
#include <vector>

#include "hooke/core/lists.h"
#include "hooke/mesh/mesh.h"
#include "hooke/springs/target_lengths.h"

namespace hooke {

/// Rest lengths over target lengths of the edges of a mesh, by edge of the adjacency, for `e:rest_ratio`.
/// Quadrilaterals lie in strips, which cannot end within them, so that no motion of the vertices makes all
/// sides equal. Each side keeps the length that those across the same strip have near it, but for what a
/// whole line of sides has in common, as at the rim of a plate; a diagonal is that of the rectangle; edges of
/// other faces keep the length of those around them. Where target lengths vary, all sides are to have these,
/// and rectangles are squares. Rest lengths cover as much as equilateral triangles of the target length, as
/// many as there are: in a mesh of equal squares they are .93 of it. `polygons`: the vertex ids of each;
/// their triangles are the faces of the mesh, in this order. The points are in memory order. Throws Error if
/// the polygons are not those faces.
std::vector<double> rest_ratios(const IntLists& polygons, const MemoryOrder& memory_order,
                                const Mat3X& points, const TargetLengths& targets);

/// How many have this number of corners.
std::size_t count_with_corners(const IntLists& polygons, std::size_t corners);

/// These targets with the lengths of edges multiplied by their ratios. Altitude springs of a face then rest
/// at the smallest altitude of the triangle with these edges.
TargetLengths at_rest_ratios(const Adjacency& adjacency, const TargetLengths& targets,
                             const std::vector<double>& ratios);

/// The area of a triangle by its sides (Heron); 0 where they make none.
double area_of_sides(double a, double b, double c);

}  // namespace hooke
