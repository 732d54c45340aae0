// Relaxation by L-BFGS on the surface, preconditioned by the local curvature of the energy and by grids (see
// preconditioner.h). Every candidate step is projected and guarded per vertex before its energy is evaluated.
// J. Nocedal, "Updating quasi-Newton matrices with limited storage", 1980.
//
// Gauss-Seidel sweeps alone (see gauss_seidel.h), 30 of them, do as well on meshes of a few thousand vertices
// in less time, but cannot even out long waves: in mode `flip` the edges of a torus of 100 000 vertices vary
// by 13.6 % after them instead of 7.8 %, and by 10.8 % after 100 sweeps in three times the time.
#pragma once

#include <deque>

#include "hooke/integrator/preconditioner.h"

namespace hooke {

struct LbfgsMemoryOptions {
  static constexpr int pairs = 3;         // of steps and gradient changes that are stored
  double first_step = .5;                 // factor of the preconditioned gradient while no pair is stored
  static constexpr int scaled_pairs = 3;  // number of first pairs that rescale the preconditioner
};

struct LbfgsOptions {
  int sweeps = 4;                              // initial Gauss-Seidel sweeps, which remove slivers
  static constexpr double sweep_factor = 1.5;  // over-relaxation of all sweeps but the first
  LbfgsMemoryOptions memory;
  PreconditionerOptions preconditioner;
  static constexpr int curvature_every = 8;  // steps between updates of the preconditioner's local curvatures
  static constexpr double armijo = 1e-4;     // minimum decrease of the energy, over the predicted one
  static constexpr int max_backtracks = 12;  // shortened candidates per step before it is given up
  /// Where guards limit too many vertices for local relaxation, and more than this part of all vertices move
  /// by the full cap, the cap is halved for the rest of the run: long-wave motion would run over the limited
  /// vertices. The edges of an uneven grid with fixed vertices in it vary by 13 % instead of 17 % in mode
  /// `flip`; the same holds for local relaxation.
  double max_capped_fraction = .25;
  static constexpr double min_cap = .25;  // lower bound of the cap, in target lengths
  double lazy_error = 1e-2;     // deviation tolerated by the retraction until the end, in mean target lengths
  bool projects_at_end = true;  // projects drifted vertices at the end; else they stay drifted
  static constexpr double locally_relaxable =
      .01;  // largest part of the vertices, limited by guards, that is relaxed locally
  static constexpr int relaxed_rings = 1;  // around the limited vertices, within which vertices move
  static constexpr int local_sweeps = 3;   // of each local relaxation
};

/// Moves relaxation.positions to a minimum of relaxation.energy on the surface; without `projects_at_end`
/// they may end up to `lazy_error` off it. With options.max_steps <= 1 only the Gauss-Seidel sweeps run.
IntegrationResult relax_lbfgs(Relaxation& relaxation, const IntegrationOptions& options,
                              const LbfgsOptions& lbfgs, const Observer& observer);

}  // namespace hooke
