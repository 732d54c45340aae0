// Flips that Delaunay does not ask for: around vertices of irregular valence, kept where the springs around
// are better off when they have settled.
#pragma once

#include "hooke/connectivity/edge_flips.h"
#include "hooke/integrator/relaxation.h"
#include "hooke/springs/energy.h"

namespace hooke {

struct GuardOptions;

struct FlipPassOptions {
  int passes = 2;      // at most; it stops when one changes nothing
  int rounds = 4;      // of a pass, at most: all but the first look at what the one before has changed
  int rings = 2;       // around the edge, within which the vertices settle
  size_t most = 200;   // vertices that settle: no edge is tried about which there are more
  int sweeps = 3;      // of Newton's method vertex by vertex, for them to settle
  double gain = 1e-4;  // least fall of the energy for a flip to be kept
  /// Greatest rise of the energy by the flip alone, and after the first sweep, for a trial to go on; in parts
  /// of the greater of the weights of strings and altitudes.
  double max_energy_rise = .35, max_rise_after_relaxation = .07;
};

/// One pass over the edges with two or more irregular vertices among the four about them. An inner vertex is
/// regular with 6 edges, one on the boundary with 4, a corner with those it wants. Vertices on creases and
/// boundaries stand still meanwhile. `near` tells, per vertex, where there is something new: only edges are
/// tried of which one of the four is there. Empty: all are. It comes back with what the last round has
/// changed. The observer is called after every few hundred edges or less. Projections of trials are not
/// counted. Returns the number of flips kept.
int flip_irregular_edges(FlippableMesh& mesh, const EnergyTerms& terms, const FlipPassOptions& options,
                         const FlipGuardOptions& flip_guard, const GuardOptions& guards,
                         std::vector<char>& near, const Observer& observer);

}  // namespace hooke
