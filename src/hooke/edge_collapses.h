// Edge collapses: an edge that is too short becomes a vertex.
#pragma once

#include "hooke/adapting_mesh.h"

namespace hooke {

struct CollapseOptions {
  double shortest = .8;  // of an edge over its target length; shorter ones collapse
  double longest =
      4. / 3;             // of an edge over its target length that a collapse may leave, unless one was there
  int valence = 9;        // greatest valence of the vertex that stays
  double angle = 10;      // degrees; least angle about the vertex that stays, unless there was a smaller one
  double alignment = .3;  // least cosine between a new face and the surface, unless an old one had less
  double fold = .1;       // least cosine between neighbouring faces, unless two old ones had less
  double sagitta = .2;    // greatest sagitta of an edge over its target length, unless an old one had more
  bool insist_on_alignment = false;  // even where an old face had less
};

/// Merges the ends of one edge and returns the vertex that stays, -1 where that is not allowed: where it
/// changes the topology, where a guard forbids it, where it takes a vertex off its curve or an edge from a
/// curve that has no more than it wants. A vertex that is less free stays where it is; of two alike that of
/// the input stays, in the middle of the edge if the guards allow it, else at one of its ends.
/// Pre-condition: the edges of the curves are counted.
int collapse_edge(AdaptingMesh& mesh, int half_edge, const CollapseOptions& options);

/// Collapses edges, the shortest first, until none is too short or no more may be. Returns the number of
/// collapses.
int collapse_short_edges(AdaptingMesh& mesh, const CollapseOptions& options);

}  // namespace hooke
