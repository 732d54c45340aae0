// Vertices that lie so close together that they are meant to be one.
#pragma once

#include <vector>

#include "hooke/core/types.h"
#include "hooke/mesh/adjacency.h"

namespace hooke {

/// A vertex merges with others up to this share of the length of its shortest boundary edge.
inline constexpr double welding_share = 1e-3;

/// For each vertex the one it is merged with, which has a smaller id and is merged with none; itself if there
/// is none. Two vertices may merge if their distance is at most the reach of each; those with a negative
/// reach never do. Each merges with the closest that is there when its turn comes, in the order of their ids.
std::vector<int> weld_vertices(const Mat3X& points, const std::vector<double>& reach);

/// The reach of the vertices at these edges: welding_share of the shortest; -1 for all other vertices.
std::vector<double> reach_of_edges(const Mat3X& points, const std::vector<Edge>& edges);

/// The same for the edges that belong to one triangle only. The triangles may be those of an invalid mesh.
std::vector<double> reach_of_boundary(const Mat3X& points, const std::vector<Triangle>& triangles);

/// Ascending, the boundary vertices at cracks: within a hundredth of the length of a boundary edge beyond
/// which the surface goes on, as at T-junctions, and no ends of it even if merged.
std::vector<int> vertices_at_cracks(const Mat3X& points, const Adjacency& adjacency);

/// Pairs of boundary vertices with exactly the same coordinates, as where a surface is cut open along a
/// texture seam; each of several in a place with the next.
std::vector<Edge> coincident_boundary_pairs(const Mat3X& points, const Adjacency& adjacency);

}  // namespace hooke
