// Edge splits: of edges that are too long, and of all edges in 1-to-4 subdivision.
#pragma once

#include <limits>

#include "hooke/core/types.h"

namespace hooke {

struct WorkingMesh;
struct SurfacePosition;

/// Maximum length of an edge over its target length; longer edges are split.
inline constexpr double max_relative_length = 4. / 3;

/// Splits one edge at its midpoint, with the new vertex on the surface, and returns that; -1 if
/// may_split_face() forbids it or the edge belongs to a fixed boundary or a junction (see junction_edges.h).
/// `middle`: see add_vertex().
int split_edge(WorkingMesh& mesh, int half_edge, const SurfacePosition* middle = nullptr);

/// May the last vertex added, with this wedge, split the face of the half-edge in two? Not if a half would be
/// a sliver, or less aligned with the surface than the limits of the local shape and the old face.
bool may_split_face(const WorkingMesh& mesh, int half_edge, int vertex, int wedge);

/// Splits edges, the longest first, until none that may be split is too long, or as often as allowed. Returns
/// the number of splits.
int split_long_edges(WorkingMesh& mesh, int max_splits = std::numeric_limits<int>::max());

/// 1-to-4 subdivision: splits every edge, with the new vertices on their feature curves or on the surface,
/// and joins the three new vertices of each face. All new inner vertices are regular. The connectivity is
/// that of one step of C. Loop, "Smooth subdivision surfaces based on triangles", 1987. Edges that may not be
/// split (see split_edge()) stay, and flips that may_flip() forbids are omitted. Target lengths do not
/// change. Returns the number of splits. Pre-condition: no id is unused, and count_curve_edges().
int subdivide(WorkingMesh& mesh);

}  // namespace hooke
