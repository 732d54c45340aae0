// Edge splits: a new vertex in the middle of an edge that is too long.
#pragma once

#include "hooke/connectivity/edge_flips.h"

namespace hooke {

struct WorkingMesh;
struct SurfacePosition;

struct SplitOptions {
  double longest = 4. / 3;  // of an edge over its target length
  double area_share = .1;   // least part of a halved face's area that each half has on the surface
  double alignment = .3;    // least cosine between a new face and the surface, unless the old one had less
};

/// Splits one edge and returns the new vertex; -1 where a guard forbids it, or where the edge joins two
/// vertices of a boundary that stands still. `middle`: see add_vertex().
int split_edge(WorkingMesh& mesh, int half_edge, const SplitOptions& options,
               const SurfacePosition* middle = nullptr);

/// Splits edges, the longest first, until none is too long. Returns the number of splits.
int split_long_edges(WorkingMesh& mesh, const SplitOptions& options);

// Subdivision: every face becomes four of half its size, whose new vertices are regular.

/// Halves every edge, the new vertices on their curves or on the surface, and joins those of each face: one
/// step of C. Loop, "Smooth subdivision surfaces based on triangles", 1987, as far as who touches whom. An
/// edge that may not be split (see split_edge()) stays whole, and flips that the guard forbids are left out.
/// Target lengths stay as they are. Returns the number of splits. Pre-condition: no id is unused, and the
/// edges of the curves are counted.
int subdivide(WorkingMesh& mesh, const SplitOptions& options, const FlipGuardOptions& flip_guard);

}  // namespace hooke
