// The damped evolution of a mesh under string and torque forces: what both the paper's Algorithm 2 and the
// guarded relaxation on the surface share, and Algorithm 2 itself.
// "Hooke's Optimization for 3D triangular mesh", sections 4.1 to 4.3, equations [17]-[26].
#pragma once

#include <span>

#include "hooke/integrator/relaxation.h"
#include "hooke/integrator/time_step.h"
#include "hooke/mesh/mesh.h"

namespace hooke {

/// The constants of [17], section 4.6. They expect target lengths of about 1: a string force is a length, a
/// torque force has no unit.
struct DampedOptions {
  double string = 2;       // string tension; positive; lambda
  double torque = 1;       // torque coefficient; mu
  double friction = 1000;  // one over a time; positive; tau
};

/// Throws Error if the string tension or the friction is not a positive number.
void require_valid(const DampedOptions& options);

/// What moves: views of the points of a mesh and of its vertex properties `v:velocity` and `v:force`, 3 x
/// |V|. Dies when vertices are added or removed.
struct Motion {
  Eigen::Map<Mat3X> points;      // v
  Eigen::Map<Mat3X> velocities;  // u
  Eigen::Map<Mat3X> forces;      // lambda F_string + mu F_torque
  double mass;                   // of one vertex, 1 / |V|; m
};

/// Views a mesh that has at least one vertex; creates the two properties if it does not have them.
Motion motion_of(TriMesh& mesh);

/// Forgets velocities and forces of an earlier run. [18]
void come_to_rest(Motion& motion);

/// How far the points go in the time dt, first line of [22].
Mat3X displacement(const Motion& motion, double friction, double dt);

/// The velocities after the time dt, second line of [22].
void accelerate(Motion& motion, double friction, double dt);

/// Greatest |l - L| of all edges; `target_lengths` has one positive length per edge.
double max_length_error(const Eigen::Ref<const Mat3X>& points, const Adjacency& adjacency,
                        std::span<const double> target_lengths);

struct EvolutionOptions {
  DampedOptions damped = {};
  TimeStepOptions time_step = {};
  double tolerance = 1e-3;  // stop when max |l - L| is below this length; d_tolerance
  int max_steps = 400;      // accepted steps
};

/// Takes from the forces what some vertices may not do.
using Restraint = std::function<void(Mat3X& forces)>;

/// One step of Algorithm 2.
struct EvolutionStep {
  bool at_rest = false;      // no force and no velocity: there was nothing to do
  AdaptedStep adapted = {};  // time, epsilon, the tests that bound it
};

/// Makes the largest step that the tests of [26] allow for the whole mesh at once: forces, points,
/// velocities. A jam or rest leaves points and velocities alone. `last_factor` is epsilon of the step before.
EvolutionStep evolution_step(Motion& motion, const Adjacency& adjacency,
                             std::span<const double> target_lengths, const EvolutionOptions& options,
                             const Restraint& restraint, double last_factor);

/// What Algorithm 2 returns. The energy is that of the strings, in parts of their rest lengths.
struct EvolutionResult : IntegrationResult {
  BoundCounts bound;            // of the accepted steps
  FailedTests jam;              // what the last trial failed, when jammed
  double time = 0;              // t_n, the sum of the time steps
  double max_length_error = 0;  // max |l - L| at the end, a length
};

/// Algorithm 2: steps from rest until max |l - L| < tolerance (converged), nothing pulls (stalled), no time
/// step passes the tests (jammed), or the step limit. A mesh that fulfils the tolerance already is not
/// touched (the paper's loop makes one step before it looks). With fixed connectivity the tolerance is mostly
/// out of reach; then another condition ends the run. `evaluations` counts all trials.
///
/// Nothing here holds the mesh on its surface. The strings alone fold it as they shorten and lengthen edges,
/// with torque or without, and next to a fold (theta near pi) the torque of [6] is so large that it can throw
/// vertices many lengths away without failing a test of [26].
EvolutionResult evolve_damped(TriMesh& mesh, const Adjacency& adjacency,
                              std::span<const double> target_lengths, const EvolutionOptions& options,
                              const Restraint& restraint = nullptr, const Observer& observer = nullptr);

// Relaxation by the damped evolution [17] on the surface: every step is retracted through the filter and
// guarded per vertex, so that one collapsing face does not stop the whole mesh.
// "Hooke's Optimization for 3D triangular mesh", sections 4.1 to 4.3.

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
