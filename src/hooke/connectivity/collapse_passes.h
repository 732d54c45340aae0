// Passes of edge collapses over the whole mesh: of edges that are too short, in parallel blocks where the
// mesh is far too fine, and of edges at folded faces.
#pragma once

#include "hooke/connectivity/edge_collapses.h"

namespace hooke {

struct BlockOptions {
  int vertices = 8192;  // maximum size of a block; its vertices have consecutive ids and are mostly close
  int passes = 3;       // with shifted blocks: edges between two blocks of one pass are inside one of another
  double length_factor = .5;  // of CollapseOptions::shortest: only edges shorter than this collapse
  double min_share = .2;      // minimum share of all edges that must be so short
};

/// Collapses inner edges in all blocks in parallel, in each block the shortest first. Vertices within two
/// edges of another block stay, and so do edges that are only a little too short, for which the order matters
/// across blocks. Does nothing in a mesh of fewer than two blocks. Returns the number of collapses.
/// Projections are not counted.
int collapse_in_blocks(WorkingMesh& mesh, const CollapseOptions& options, const BlockOptions& blocks);

/// Collapses edges until none is too short or no further collapse is allowed. Works in batches, the shortest
/// edges first, except for edges that become shorter during a batch. Returns the number of collapses.
int collapse_short_edges(WorkingMesh& mesh, const CollapseOptions& options);

/// Looser limits for edges at a folded face, where the usual limits allow no collapse.
inline CollapseOptions folded_face_options() {
  return {.longest = 2, .valence = 12, .angle = 2, .sagitta = .5, .insist_on_alignment = true};
}

/// Removes folded faces (alignment with the surface below the limit), which vertex motion cannot unfold: for
/// each, collapses the first of its edges or of the edges at its corners that the options allow. Returns the
/// number of collapses.
int collapse_folded_faces(WorkingMesh& mesh, const CollapseOptions& options);

}  // namespace hooke
