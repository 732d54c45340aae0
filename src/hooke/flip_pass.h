// Flips that Delaunay does not ask for: around vertices of irregular valence, kept where the springs around
// are better off when they have settled.
#pragma once

#include "hooke/edge_flips.h"
#include "hooke/energy.h"
#include "hooke/guards.h"

namespace hooke {

struct FlipPassOptions {
  int passes = 8;      // at most; it stops when one changes nothing
  int rings = 3;       // around the edge, within which the vertices settle
  int sweeps = 4;      // of Newton's method vertex by vertex, for them to settle
  double gain = 1e-4;  // least fall of the energy for a flip to be kept
};

/// One pass over the edges with two or more irregular vertices among the four about them. An inner vertex is
/// regular with 6 edges, one on the boundary with 4, a corner with those it wants. Vertices on creases stand
/// still meanwhile. Returns the number of flips kept.
int flip_irregular_edges(FlippingMesh& mesh, const EnergyTerms& terms, const FlipPassOptions& options,
                         const FlipGuardOptions& flip_guard, const GuardOptions& guards);

}  // namespace hooke
