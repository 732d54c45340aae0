// The mesh parted at its creases: what the faces on either side see of a vertex, and the mesh cut open, in
// which each smooth piece is on its own.
#pragma once

#include "hooke/mesh/adjacency.h"

namespace hooke {

/// Marks the edges that join these pairs of vertices as creases and gives every vertex a side for each of the
/// sectors that creases part its faces into. A vertex's sides are numbered by the neighbour at which their
/// sector starts, counter-clockwise; flips of other edges do not change that. Pairs without an edge are left
/// out.
void part_at_creases(Connectivity& connectivity, const std::vector<Edge>& creases);

/// The same, not parted.
Connectivity without_creases(Connectivity connectivity);

/// The edges that are marked, as pairs of vertices.
std::vector<Edge> crease_edges(const Connectivity& connectivity);

/// The mesh on its sides: cut along the creases, further sides as vertices of their own.
Connectivity cut_open(const Connectivity& connectivity);

/// For each side of the connectivity the one that its corners had before: `sides` are those of the faces'
/// corners then, and `vertices` the ids then of the vertices, for those without faces.
std::vector<int> sides_before(const Connectivity& connectivity, const std::vector<Triangle>& sides,
                              std::vector<int> vertices);

/// Per vertex: its second side, -1 without one; empty without creases. `further_sides` are a connectivity's.
std::vector<int> other_sides(std::size_t vertex_count, const std::vector<int>& further_sides);

/// Points of all sides.
Mat3X side_points(const Mat3X& points, const Connectivity& connectivity);

/// Per vertex: its connected component, numbered in the order of their first vertices.
std::vector<int> label_components(const Connectivity& connectivity);

}  // namespace hooke
