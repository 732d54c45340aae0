// The limited memory of L-BFGS: the last steps and changes of the gradient, and what they make of a vector.
// J. Nocedal, "Updating quasi-Newton matrices with limited storage", 1980.
#pragma once

#include <deque>

#include "hooke/integrator/preconditioner.h"

namespace hooke {

struct LbfgsMemoryOptions {
  int pairs = 3;           // of steps and gradient changes
  double first_step = .5;  // of the preconditioned gradient, while there is no memory
  int scaled_pairs = 3;    // the preconditioner is scaled to the last pair until this many are held
};

// Relaxation by L-BFGS on the surface, preconditioned by the curvature around each vertex and by grids.
// J. Nocedal, "Updating quasi-Newton matrices with limited storage", 1980; for the grids see multigrid.h.
// Every trial step is retracted through the filter and guarded per vertex before its energy counts.

struct LbfgsOptions {
  int sweeps = 4;             // of Newton's method vertex by vertex, first: they remove the slivers
  double sweep_factor = 1.5;  // over-relaxation of all sweeps but the first
  LbfgsMemoryOptions memory;
  PreconditionerOptions preconditioner;
  int curvature_every = 8;  // steps after which the curvature around the vertices is taken anew
  double armijo = 1e-4;     // part of the predicted decrease that a step must bring
  int max_backtracks = 12;  // halvings of a step before it is given up
  /// Where guards hold too many back to mend, and more than this part of the vertices go as far as they may,
  /// long waves run over the places that stand: from then on all may go half as far.
  double carried = .25;
  double min_cap = .25;         // but no less than this, in target lengths
  double lazy_error = 1e-2;     // of the retraction on the way, in mean target lengths
  bool projects_at_end = true;  // at the end; else the vertices stay where they have drifted to
  double locally_relaxable =
      .01;                // part of the vertices: no more than so many that guards hold back are mended
  int relaxed_rings = 1;  // about them, within which vertices move ...
  int local_sweeps = 3;   // ... in so many sweeps
};

/// Moves relaxation.placement to a minimum of relaxation.energy on the surface or, unless it settles, no
/// farther off than `lazy_error`. With a single evaluation allowed there are only the sweeps.
IntegrationResult relax_lbfgs(Relaxation& relaxation, const IntegrationOptions& options,
                              const LbfgsOptions& lbfgs, const Observer& observer);

}  // namespace hooke
