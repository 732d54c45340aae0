// One edge collapse: may it be, and where does the vertex that stays come to lie?
#pragma once

#include <optional>

#include "hooke/working_mesh/adapting_mesh.h"

namespace hooke {

struct CollapseOptions {
  double shortest = .8;  // of an edge over its target length; shorter ones collapse
  /// Of an edge over its target length that a collapse may leave, unless there was one as long at its ends;
  /// before the vertex that stays goes back to the surface.
  double longest = 4. / 3;
  int valence = 9;        // greatest valence of the vertex that stays
  double angle = 10;      // degrees; least angle about the vertex that stays, unless there was a smaller one
  double alignment = .3;  // least cosine between a new face and the surface, unless an old one had less
  double fold = .1;       // least cosine between neighbouring faces, unless two old ones had less
  double sagitta = .2;    // greatest sagitta of an edge over its target length, unless an old one had more
  bool insist_on_alignment = false;  // even where an old face had less
};

struct Collapse {
  int half_edge;
  int stays;          // the vertex of the edge that does
  VertexPlace place;  // where
};

/// Of the vertex that stays.
int valence_after(const AdaptingMesh& mesh, int half_edge);

/// Nothing where the edge may not collapse: where that changes the topology, where a guard forbids it, where
/// it takes a vertex off its curve or an edge from a curve that has no more than it wants. A vertex that is
/// less free stays where it is; of two alike that of the input stays, in the middle of the edge if the guards
/// allow it, else at one of its ends.
/// The mesh is only looked at: edges may be tried at the same time, and of those without a vertex or
/// neighbour in common all may be made that pass, but for what their curves want. Projections are not
/// counted.
/// Pre-condition: the edges of the curves are counted.
std::optional<Collapse> try_collapse(const AdaptingMesh& mesh, int half_edge, const CollapseOptions& options);

/// Makes a collapse that has passed its trial.
void make_collapse(AdaptingMesh& mesh, const Collapse& collapse);

/// Both: merges the ends of the edge and returns the vertex that stays, -1 where that is not allowed.
int collapse_edge(AdaptingMesh& mesh, int half_edge, const CollapseOptions& options);

/// The curve of the edge has more edges than it wants, or the edge has no curve.
bool curve_may_lose(const AdaptingMesh& mesh, int half_edge);

}  // namespace hooke
