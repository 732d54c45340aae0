// Edge collapses of a mesh that is far too fine: in blocks of vertices, each on its own.
#pragma once

#include "hooke/connectivity/edge_collapses.h"

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
int collapse_in_blocks(WorkingMesh& mesh, const CollapseOptions& options, const BlockOptions& blocks);

// Edge collapses: an edge that is too short becomes a vertex.

/// Collapses edges until none is too short or no more may be: many at a time, the shortest first but for
/// those that come to be shorter meanwhile. Returns the number of collapses.
int collapse_short_edges(WorkingMesh& mesh, const CollapseOptions& options);

// Collapses about folded faces, which no motion mends.

/// What the edges about a folded face may become: more than by the usual collapse, which finds no way there.
inline CollapseOptions folded_face_options() {
  return {.longest = 2, .valence = 12, .angle = 2, .sagitta = .5, .insist_on_alignment = true};
}

/// Where a face lies against the surface (alignment below the limit), collapses an edge of it or at its
/// corners, if the options allow it. Returns the number of collapses.
int collapse_folded_faces(WorkingMesh& mesh, const CollapseOptions& options);

}  // namespace hooke
