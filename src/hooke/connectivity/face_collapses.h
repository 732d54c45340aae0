// Collapses about folded faces, which no motion mends.
#pragma once

#include "hooke/connectivity/edge_collapses.h"

namespace hooke {

/// What the edges about a folded face may become: more than by the usual collapse, which finds no way there.
inline CollapseOptions folded_face_options() {
  return {.longest = 2, .valence = 12, .angle = 2, .sagitta = .5, .insist_on_alignment = true};
}

/// Where a face lies against the surface (alignment below the limit), collapses an edge of it or at its
/// corners, if the options allow it. Returns the number of collapses.
int collapse_folded_faces(AdaptingMesh& mesh, const CollapseOptions& options);

}  // namespace hooke
