// Filtered Hooke's Optimization as published: Algorithms 1 to 3 with the published constants, for comparison.
// "Hooke's Optimization for 3D triangular mesh", section 4.6.
#pragma once

#include "hooke/constraints/constraints.h"
#include "hooke/filter/retraction.h"
#include "hooke/filter/surface_field.h"
#include "hooke/integrator/damped_evolution.h"
#include "hooke/remesh/result.h"

namespace hooke {

/// The published constants. The mesh is normalised to a mean target length of 1 first: a string force is a
/// length, a torque force has no unit. The published offset rho = 1e-3 is about .02 of the normalised length.
struct PaperOptions {
  EvolutionOptions evolution;  // Algorithm 2, for each outer iteration; tolerance in mean target lengths
  FilterOptions filter{.kind = FilterKind::global, .kernel = Kernel::r2logr, .offset = .02};
  RetractionOptions retraction;
  ConstraintOptions constraints{.boundary = BoundaryRule::free,  // the paper does not speak of boundaries
                                .features = {.angle = 180}};     // or creases
  int max_outer = 10;                                            // outer iterations
  double outer_drop = 1e-3;  // stalled when an outer iteration lowers the energy by less than this part
};

/// Algorithm 1: { fit the spline to M_t [30]-[33]; Algorithm 2 from rest; Newton projection [36] } until
/// max |l - L| < tolerance. That tolerance is mostly out of reach with fixed connectivity, so an outer
/// iteration that lowers the energy of the strings no further ends the work too (jammed if no time step
/// passed the tests in it, else stalled), as do the limits. No altitude springs, no guards, no untangling, no
/// polish: faces may fold, and RemeshResult::folded_faces names those that lie folded away from the input's
/// surface. RemeshResult::bound and ::jam tell which test of [26] set the time steps.
///
/// A vertex that Newton does not bring back lands on the closest point of the faces and is counted in
/// RemeshResult::projection; [37] would send it to infinity.
/// Throws LimitError or NumericalError when the spline cannot be fitted; the mesh is as it was then.
RemeshResult paper_remesh(TriMesh& mesh, const PaperOptions& options, const Observer& observer = nullptr);

/// The same with the mesh's layout, where it is known already.
RemeshResult paper_remesh(TriMesh& mesh, MemoryOrder memory_order, const PaperOptions& options,
                          const Observer& observer = nullptr);

}  // namespace hooke
