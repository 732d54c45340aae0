// Edge splits: a new vertex in the middle of an edge that is too long.
#pragma once

#include "hooke/working_mesh/adapting_mesh.h"

namespace hooke {

struct SplitOptions {
  double longest = 4. / 3;  // of an edge over its target length
  double area_share = .1;   // least part of a halved face's area that each half has on the surface
  double alignment = .3;    // least cosine between a new face and the surface, unless the old one had less
};

/// Splits one edge and returns the new vertex; -1 where a guard forbids it, or where the edge joins two
/// vertices of a boundary that stands still. `middle`: see add_vertex().
int split_edge(AdaptingMesh& mesh, int half_edge, const SplitOptions& options,
               const VertexPlace* middle = nullptr);

/// Splits edges, the longest first, until none is too long. Returns the number of splits.
int split_long_edges(AdaptingMesh& mesh, const SplitOptions& options);

}  // namespace hooke
