// Relaxation by the damped evolution [17] on the surface: every step is retracted through the filter and
// guarded per vertex, so that one collapsing face does not stop the whole mesh.
// "Hooke's Optimization for 3D triangular mesh", sections 4.1 to 4.3.
#pragma once

#include "hooke/integrator/damped_evolution.h"

namespace hooke {

/// Moves relaxation.placement from rest toward an equilibrium on the surface. The forces are
/// lambda * (minus the gradient of relaxation.energy) + mu * F_torque, less what the vertices may not do;
/// they, the velocities and the points stand on `mesh` (v:force, v:velocity), whatever was there before. A
/// vertex that the cap (options.max_move) or the guards hold back keeps that part of its velocity.
/// Pre-condition: the mesh has the vertices of the relaxation.
///
/// Time step: dt = epsilon sqrt(m / lambda), in parts of the period of a string of rest length 1, instead of
/// [24], which one short edge or one large force would drive to zero; the cap takes care of those vertices.
/// epsilon starts at 1/2, grows a little with every accepted step, and halves when a step is rejected: when
/// it raises the energy by more than the work that the torque did. A rejected step also brings the mesh to
/// rest.
///
/// A trial counts as one of options.max_steps. Ends at rest (stalled; over ten times options.window steps,
/// which are shorter than those of L-BFGS), at that limit, or jammed when no time step is accepted. Throws
/// Error if the string tension or the friction is not positive, NumericalError if the forces at the start are
/// not finite.
IntegrationResult relax_damped(Relaxation& relaxation, TriMesh& mesh, const IntegrationOptions& options,
                               const DampedOptions& damped, const Observer& observer);

}  // namespace hooke
