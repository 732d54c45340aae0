// Filtered Hooke's Optimization as published: Algorithms 1 to 3 with the published constants, for comparison.
// "Hooke's Optimization for 3D triangular mesh", section 4.6.
#pragma once

#include "hooke/constraints/constraint_options.h"
#include "hooke/filter/filter.h"
#include "hooke/filter/retraction.h"
#include "hooke/integrator/damped_evolution.h"
#include "hooke/remesh/result.h"

namespace hooke {

/// When vertices are filtered.
enum class FilterEvery {
  step,   // after each time step: the half steps of [22], kappa at n + 1 in [26], section 3.3
  outer,  // after Algorithm 2 has ended: Algorithm 1
};

/// The published constants, and altitude springs. The mesh is first normalised to a mean target length of 1,
/// since a string force is a length but a torque force has no unit.
struct PaperOptions {
  EvolutionOptions evolution{.altitude = 1};  // Algorithm 2; tolerance in mean target lengths
  FilterEvery filter_every = FilterEvery::step;
  Refit refit = Refit::once;  // once: psi of M_0; each: psi of M_t before each outer iteration
  FilterOptions filter{.kind = FilterKind::global,
                       .kernel = Kernel::r2logr,
                       .offset = 1e-3,
                       .offset_unit = OffsetUnit::file,
                       .inward = true,
                       .facets = false};
  ConstraintOptions constraints{.boundary = BoundaryRule::free,  // the paper treats neither boundaries
                                .features = {.angle = 180}};     // nor creases
  int max_outer = 25;                                            // maximum number of outer iterations
  double outer_drop = 1e-3;  // stalled when an outer iteration lowers the energy by less than this share
};

/// Algorithm 1: { fit the spline [30]-[33]; Algorithm 2 from rest, with a Newton projection [36] after each
/// time step; Newton projection } until max |l - L| < tolerance. With fixed connectivity that tolerance is
/// mostly unreachable, so the run also ends when an outer iteration no longer lowers the energy of the
/// strings (jammed if no time step passed the tests in it or strong forces are left, else stalled), and at
/// the limits. There are no guards, no untangling and no angle optimisation: faces may fold.
/// RemeshResult::bound and ::jam tell which test of [26] set the time steps.
///
/// What departs from the letter of the paper, and what happens otherwise, stands in src/README.md.
///
/// A vertex for which the Newton projection fails is projected to the closest point of the faces and counted
/// in RemeshResult::projection; [37] would send it to infinity.
/// Throws LimitError or NumericalError if the spline cannot be fitted; the mesh is then unchanged.
RemeshResult paper_remesh(TriMesh& mesh, const PaperOptions& options, const Observer& observer = nullptr);

/// The same for a mesh whose memory order is known.
RemeshResult paper_remesh(TriMesh& mesh, MemoryOrder memory_order, const PaperOptions& options,
                          const Observer& observer = nullptr);

}  // namespace hooke
