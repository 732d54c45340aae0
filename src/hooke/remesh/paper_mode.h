// Filtered Hooke's Optimization as published: Algorithms 1 to 3 with the published constants, for comparison.
// "Hooke's Optimization for 3D triangular mesh", section 4.6.
#pragma once

#include "hooke/constraints/constraints.h"
#include "hooke/filter/retraction.h"
#include "hooke/filter/surface_field.h"
#include "hooke/integrator/damped_evolution.h"
#include "hooke/remesh/result.h"

namespace hooke {

/// The published constants. The mesh is first normalised to a mean target length of 1, since a string force
/// is a length but a torque force has no unit. The published offset rho = 1e-3 is about .02 normalised
/// lengths.
struct PaperOptions {
  EvolutionOptions evolution;  // Algorithm 2, for each outer iteration; tolerance in mean target lengths
  FilterOptions filter{.kind = FilterKind::global, .kernel = Kernel::r2logr, .offset = .02};
  RetractionOptions retraction;
  ConstraintOptions constraints{.boundary = BoundaryRule::free,  // the paper treats neither boundaries
                                .features = {.angle = 180}};     // nor creases
  int max_outer = 10;                                            // maximum number of outer iterations
  double outer_drop = 1e-3;  // stalled when an outer iteration lowers the energy by less than this share
};

/// Algorithm 1: { fit the spline to M_t [30]-[33]; Algorithm 2 from rest; Newton projection [36] } until
/// max |l - L| < tolerance. With fixed connectivity that tolerance is mostly unreachable, so the run also
/// ends when an outer iteration no longer lowers the energy of the strings (jammed if no time step passed the
/// tests in it, else stalled), and at the limits. There are no altitude springs, guards, untangling or angle
/// optimisation: faces may fold, and RemeshResult::folded_faces lists those folded against the surface of the
/// input. RemeshResult::bound and ::jam tell which test of [26] set the time steps.
///
/// A vertex for which the Newton projection fails is projected to the closest point of the faces and counted
/// in RemeshResult::projection; [37] would send it to infinity.
/// Throws LimitError or NumericalError if the spline cannot be fitted; the mesh is then unchanged.
RemeshResult paper_remesh(TriMesh& mesh, const PaperOptions& options, const Observer& observer = nullptr);

/// The same for a mesh whose memory order is known.
RemeshResult paper_remesh(TriMesh& mesh, MemoryOrder memory_order, const PaperOptions& options,
                          const Observer& observer = nullptr);

}  // namespace hooke
