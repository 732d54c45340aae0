// Flips of edges near vertices of irregular valence, beyond those of Delaunay: a flip is kept if it lowers
// the spring energy of its relaxed neighbourhood.
#pragma once

#include "hooke/connectivity/edge_flips.h"
#include "hooke/integrator/integration.h"
#include "hooke/springs/energy.h"

namespace hooke {

struct ShapeLimits;

struct FlipPassOptions {
  int passes = 2;             // maximum number; they end when a pass flips nothing
  int rounds = 4;             // maximum number per pass; after the first, only changed regions are tested
  int rings = 2;              // around the edge, within which vertices are relaxed
  size_t max_vertices = 200;  // maximum number of relaxed vertices; edges with more are not tested
  int sweeps = 3;             // of Newton's method vertex by vertex, to relax the patch
  double gain = 1e-4;         // minimum decrease of the energy for a flip to be kept
  /// Maximum energy rise by the flip alone, and after each sweep but the last, for a test to go on; in units
  /// of the larger of the weights of strings and altitude springs.
  double max_energy_rise = .35, max_rise_after_relaxation = .07;
};

/// One pass over the edges that have two or more irregular vertices among the four of their two faces. An
/// inner vertex is regular with 6 edges, one on the boundary with 4, a corner with its target valence.
/// Vertices on feature edges do not move. `near`: one flag per vertex; only edges with a flagged vertex among
/// the four are tested, or all if it is empty. On return it flags the vertices that the last round has
/// changed. The observer is called at least every few hundred edges. Projections in the tests are not
/// counted. Returns the number of flips kept.
int flip_irregular_edges(WorkingMesh& mesh, const EnergyTerms& terms, const FlipPassOptions& options,
                         const ShapeLimits& limits, std::vector<char>& near, const Observer& observer);

}  // namespace hooke
