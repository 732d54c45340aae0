// Collapses about faces that no motion mends: folded ones, and slivers that the guards hold.
#pragma once

#include "hooke/edge_collapses.h"

namespace hooke {

struct FaceCollapseOptions {
  double sliver_angle = 30;  // degrees; faces with a smaller angle are slivers
  double angle_gain = 2;     // degrees by which a collapse is to raise the least angle of a sliver
  int rounds = 4;            // over the slivers
  // What the edges about a bad face may become, where those of the usual collapse find no way.
  CollapseOptions folded = {.longest = 2, .valence = 12, .angle = 2, .sagitta = .5};
  CollapseOptions sliver = {.longest = 1.7, .sagitta = .3};
};

/// Where a face lies against the surface (alignment below the limit), collapses an edge of it or at its
/// corners, if that leaves no such face there. Returns the number of collapses.
int collapse_folded_faces(AdaptingMesh& mesh, const FaceCollapseOptions& options);

/// The same for slivers, if it leaves only greater angles there, and no fewer than `least_faces` in all.
int collapse_slivers(AdaptingMesh& mesh, const FaceCollapseOptions& options, double least_faces);

}  // namespace hooke
