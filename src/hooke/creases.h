// The mesh parted at its creases: what the faces on either side see of a vertex, and the mesh cut open, in
// which each smooth piece is on its own.
#pragma once

#include "hooke/connectivity.h"

namespace hooke {

/// Marks the edges that join these pairs of vertices as creases and gives every vertex a side for each of the
/// sectors that creases part its faces into. A vertex's sides are numbered by the neighbour at which their
/// sector starts, counter-clockwise; flips of other edges do not change that. Pairs without an edge are left
/// out.
void part_at_creases(Connectivity& connectivity, const std::vector<Edge>& creases);

/// The edges that are marked, as pairs of vertices.
std::vector<Edge> crease_edges(const Connectivity& connectivity);

/// The mesh on its sides: cut along the creases, further sides as vertices of their own.
Connectivity cut_open(const Connectivity& connectivity);

/// Points of all sides.
Mat3X side_points(const Mat3X& points, const Connectivity& connectivity);

/// Per vertex: its connected component, numbered in the order of their first vertices.
std::vector<int> label_components(const Connectivity& connectivity);

}  // namespace hooke
