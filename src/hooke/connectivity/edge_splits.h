// Edge splits: of edges that are too long, and of all edges in 1-to-4 subdivision.
#pragma once

#include "hooke/core/types.h"

namespace hooke {

struct WorkingMesh;
struct SurfacePosition;

/// Maximum length of an edge over its target length; longer edges are split.
inline constexpr double max_relative_length = 4. / 3;

/// Splits one edge at its midpoint, with the new vertex on the surface, and returns that; -1 if a new face
/// would be a sliver or less aligned than the limits of the local shape and the old face, or if the edge
/// belongs to a fixed boundary or a junction. `middle`: see add_vertex().
int split_edge(WorkingMesh& mesh, int half_edge, const SurfacePosition* middle = nullptr);

/// Splits the edges of junctions (see mesh/junctions.h) that are too long in one of their sheets, in all
/// sheets at once and exactly in the middle, until none is. The new vertices stand still. Returns the number
/// of splits. No other function splits these edges.
int split_junctions(WorkingMesh& mesh);

/// Splits edges, the longest first, until none that may be split is too long. Returns the number of splits.
int split_long_edges(WorkingMesh& mesh);

/// 1-to-4 subdivision: splits every edge, with the new vertices on their feature curves or on the surface,
/// and joins the three new vertices of each face. All new inner vertices are regular. The connectivity is
/// that of one step of C. Loop, "Smooth subdivision surfaces based on triangles", 1987. Edges that may not be
/// split (see split_edge()) stay, and flips that may_flip() forbids are omitted. Target lengths do not
/// change. Returns the number of splits. Pre-condition: no id is unused, and count_curve_edges().
int subdivide(WorkingMesh& mesh);

}  // namespace hooke
