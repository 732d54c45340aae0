// The mesh parted at its creases: what the faces on either side see of a vertex, and the mesh cut open, in
// which each smooth piece is on its own.
#pragma once

#include "hooke/mesh/adjacency.h"

namespace hooke {

/// Marks the edges that join these pairs of vertices as creases and gives every vertex a side for each of the
/// sectors that creases part its faces into. A vertex's sides are numbered by the neighbour at which their
/// sector starts, counter-clockwise; flips of other edges do not change that. Pairs without an edge are left
/// out.
void split_wedges(Adjacency& adjacency, const std::vector<Edge>& creases);

/// The same, not parted.
Adjacency without_creases(Adjacency adjacency);

/// The edges that are marked, as pairs of vertices.
std::vector<Edge> crease_edges(const Adjacency& adjacency);

/// The mesh on its sides: cut along the creases, further sides as vertices of their own.
Adjacency cut_open(const Adjacency& adjacency);

/// For each side of the connectivity the one that its corners had before: `sides` are those of the faces'
/// corners then, and `vertices` the ids then of the vertices, for those without faces.
std::vector<int> wedges_before(const Adjacency& adjacency, const std::vector<Triangle>& wedges,
                               std::vector<int> vertices);

/// Per vertex: its second side, -1 without one; empty without creases. `extra_wedges` are a connectivity's.
std::vector<int> other_wedges(std::size_t vertex_count, const std::vector<int>& extra_wedges);

/// Points of all sides.
Mat3X wedge_points(const Mat3X& points, const Adjacency& adjacency);

/// Per vertex: its connected component, numbered in the order of their first vertices.
std::vector<int> label_components(const Adjacency& adjacency);

}  // namespace hooke
