// Edge splits: of edges that are too long, and of all edges in 1-to-4 subdivision.
#pragma once

#include "hooke/connectivity/edge_flips.h"

namespace hooke {

struct WorkingMesh;
struct SurfacePosition;

struct SplitOptions {
  double longest = 4. / 3;  // edge length over target length; longer edges are split
  double area_share = .1;   // minimum share of a split face's area in each half, new vertex on the surface
  double alignment = .3;    // minimum cosine between a new face and the surface, unless the old one had less
};

/// Splits one edge at its midpoint and returns the new vertex; -1 if a limit of the options forbids it or the
/// edge belongs to a fixed boundary or a junction. `middle`: see add_vertex().
int split_edge(WorkingMesh& mesh, int half_edge, const SplitOptions& options,
               const SurfacePosition* middle = nullptr);

/// Splits the edges of junctions (see mesh/junctions.h) that are too long in one of their sheets, in all
/// sheets at once and exactly in the middle, until none is. The new vertices stand still. Returns the number
/// of splits. No other function splits these edges.
int split_junctions(WorkingMesh& mesh, double longest);

/// Splits edges, the longest first, until none that may be split is too long. Returns the number of splits.
int split_long_edges(WorkingMesh& mesh, const SplitOptions& options);

/// 1-to-4 subdivision: splits every edge, with the new vertices on their feature curves or on the surface,
/// and joins the three new vertices of each face. All new inner vertices are regular. The connectivity is
/// that of one step of C. Loop, "Smooth subdivision surfaces based on triangles", 1987. Edges that may not be
/// split (see split_edge()) stay, and flips that may_flip() forbids are omitted. Target lengths do not
/// change. Returns the number of splits. Pre-condition: no id is unused, and count_curve_edges().
int subdivide(WorkingMesh& mesh, const SplitOptions& options, const FlipGuardOptions& flip_guard);

}  // namespace hooke
