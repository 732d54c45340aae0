// Detects creases: chains of sharp edges that belong to the shape, as opposed to noise, by hysteresis
// thresholding; and tips.
// J. Canny, "A computational approach to edge detection", 1986.
#pragma once

#include "hooke/constraints/constraint_options.h"
#include "hooke/mesh/adjacency.h"

namespace hooke {

/// The crease edges, ascending. An edge qualifies if its faces meet at a sharp angle while each of them
/// continues nearly flat across one of its other edges: a coarse mesh of a round body bends at every edge.
/// Where a crease has begun a sharp edge may go on with it between rounder faces. A chain has a loose
/// end where no other crease or chain continues from its last vertex. Noise makes short chains, so chains
/// with a loose end must be long, straight and clean, or sharp beyond what noise makes; so must chains from
/// the boundary, unless all their edges are sharp between flat faces and they lead to a crease or to the
/// boundary. The chains that remain form networks; networks with many corners between rough faces are noise.
/// Edges that the target length resolves are added whatever the chains: sharp ones, and weaker ones between
/// flat regions where most faces are in such regions. Lone edges are dropped. The steps of a binary mask that
/// the target length does not resolve are noise, see is_staircase(), and so are the folds of zigzag strips.
/// Networks of creases along grid bevels give way to edges that are sharper than these. `vertex_length` is
/// the target length at each vertex. `hard_edges`, by their vertices, are creases whatever the rest where
/// they bend enough to continue one.
std::vector<int> detect_creases(const Mat3X& points, const Adjacency& adjacency,
                                const std::vector<double>& vertex_length, const CreaseOptions& options,
                                const std::vector<Edge>& hard_edges = {});

/// Is the mesh an isosurface, see is_isosurface(), with slivers between the creases along its bevels? Then
/// its flat faces and bevels are taken for those of the grid, not of the shape.
bool has_grid_bevels(const Mat3X& points, const Adjacency& adjacency,
                     const std::vector<double>& vertex_length, const CreaseOptions& options);

/// The tips of cones and pyramids, ascending: vertices without a crease or boundary edge whose faces span
/// less than a full turn by more than `tip_defect`, and whose edges the target length resolves.
std::vector<int> detect_tips(const Mat3X& points, const Adjacency& with_creases,
                             const std::vector<double>& vertex_length, const CreaseOptions& options);

}  // namespace hooke
