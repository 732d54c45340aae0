// Edge collapses of a mesh that is far too fine: in blocks of vertices, each on its own.
#pragma once

#include "hooke/connectivity/collapse_trial.h"

namespace hooke {

struct BlockOptions {
  int vertices = 8192;  // of a block, at most: they follow each other, and are mostly close together
  int passes = 3;       // each with other blocks: what lay between two is inside one
  double part = .5;     // of the shortest length that may stay: only shorter edges collapse ...
  double share = .2;    // ... and only where at least this part of all edges is that short
};

/// Collapses inner edges, in each block the shortest first, all blocks at the same time. What lies within two
/// edges of another block stays, and so do edges that are not much too short: for those the order matters
/// across the blocks. Nothing in a mesh of fewer than two blocks. Returns the number of collapses.
/// Projections are not counted.
int collapse_in_blocks(AdaptingMesh& mesh, const CollapseOptions& options, const BlockOptions& blocks);

}  // namespace hooke
