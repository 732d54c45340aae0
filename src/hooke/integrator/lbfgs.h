// Relaxation by L-BFGS on the surface, preconditioned by the local curvature of the energy and by grids (see
// preconditioner.h). Every candidate step is projected and guarded per vertex before its energy is evaluated.
// J. Nocedal, "Updating quasi-Newton matrices with limited storage", 1980.
//
// Gauss-Seidel sweeps alone (see gauss_seidel.h), 30 of them, do as well on meshes of a few thousand vertices
// in less time, but cannot even out long waves: in mode `flip` the edges of a torus of 100 000 vertices vary
// by 13.6 % after them instead of 7.8 %, and by 10.8 % after 100 sweeps in three times the time.
#pragma once

#include "hooke/integrator/integration.h"

namespace hooke {

struct Relaxation;

struct LbfgsOptions {
  int sweeps = 4;  // initial Gauss-Seidel sweeps, which remove slivers
  /// Where guards limit too many vertices for local relaxation, and more than this part of all vertices move
  /// by the full cap, the cap is halved for the rest of the run: long-wave motion would run over the limited
  /// vertices. The edges of an uneven grid with fixed vertices in it vary by 13 % instead of 17 % in mode
  /// `flip`; the same holds for local relaxation.
  double max_capped_fraction = .25;
  bool projects_at_end = true;  // projects drifted vertices at the end; else they stay drifted
};

/// Moves relaxation.positions to a minimum of relaxation.energy on the surface; without `projects_at_end`
/// they may end up to a hundredth of the mean target length off it. With options.max_steps <= 1 only the
/// Gauss-Seidel sweeps run.
IntegrationResult relax_lbfgs(Relaxation& relaxation, const IntegrationOptions& options,
                              const LbfgsOptions& lbfgs, const Observer& observer);

}  // namespace hooke
