// Newton's method vertex by vertex (nonlinear Gauss-Seidel): each vertex in turn goes to the minimum of the
// energy around it, in its tangent plane, guarded. Coloured, so that vertices of one colour move at once and
// the result does not depend on the number of threads.
#pragma once

#include "hooke/integrator.h"

namespace hooke {

/// Classes of vertices of which no two share an edge; first fit in vertex order.
std::vector<std::vector<int>> colour_vertices(const Connectivity& connectivity);

struct LocalNewtonOptions {
  double max_move = .5;  // of a vertex, in its target lengths
  double over_relaxation = 1;
  int max_halvings = 5;  // of a move that breaks a guard or raises the energy, before the vertex stays
};

/// One sweep over the colours; vertices with `active` false stay (empty: all move). Returns the largest move
/// in target lengths.
double local_newton_sweep(Relaxation& relaxation, const std::vector<std::vector<int>>& colours,
                          const std::vector<char>& active, const LocalNewtonOptions& options);

}  // namespace hooke
