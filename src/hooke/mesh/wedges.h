// Wedges: creases divide the faces around a vertex into wedges, which have normals of their own. Cut open
// along its creases, the mesh has a vertex for each wedge.
// H. Hoppe, "Efficient implementation of progressive meshes", Computers & Graphics 22, 1998.
#pragma once

#include "hooke/mesh/adjacency.h"

namespace hooke {

/// Marks the edges between these pairs of vertices as creases and gives every vertex on them a wedge for each
/// sector of faces between its feature edges. The wedges of a vertex are numbered by the neighbour at which
/// their sector starts, counter-clockwise; flips of other edges do not change that. Pairs without an edge are
/// ignored.
void split_wedges(Adjacency& adjacency, const std::vector<Edge>& creases);

/// The same adjacency without creases and extra wedges.
Adjacency without_creases(Adjacency adjacency);

/// The crease edges, as pairs of vertices.
std::vector<Edge> crease_edges(const Adjacency& adjacency);

/// Adjacency of the mesh cut open along its creases, whose vertices are the wedges.
Adjacency cut_open(const Adjacency& adjacency);

/// For each wedge of the adjacency the one that its corners had before: `wedges` are the previous wedges of
/// the corners of the faces, and `vertices` the previous ids of the vertices, for those without faces.
std::vector<int> wedges_before(const Adjacency& adjacency, const std::vector<Triangle>& wedges,
                               std::vector<int> vertices);

/// Per vertex: its second wedge, -1 without one; empty without creases. `extra_wedges` as in Adjacency.
std::vector<int> other_wedges(std::size_t vertex_count, const std::vector<int>& extra_wedges);

/// Points of all wedges, 3 x wedge_count().
Mat3X wedge_points(const Mat3X& points, const Adjacency& adjacency);

/// Per vertex: its connected component, numbered in the order of their first vertices.
std::vector<int> label_components(const Adjacency& adjacency);

}  // namespace hooke
