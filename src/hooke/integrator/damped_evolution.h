// Damped evolution of a mesh under string and torque forces: the paper's Algorithm 2, and a relaxation on the
// surface whose steps are projected and guarded per vertex, so that a collapsing face does not stop the whole
// mesh.
// "Hooke's Optimization for 3D triangular mesh", sections 4.1 to 4.3, equations [17]-[26].
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "hooke/integrator/integration.h"
#include "hooke/integrator/time_step.h"
#include "hooke/mesh/mesh.h"

namespace hooke {

class Retraction;
struct Relaxation;
struct SurfacePositions;

/// Throws Error if the string tension or the friction is not a positive number.
void require_valid(const DampedOptions& options);

/// The state of motion: views of the points of a mesh and of its vertex properties `v:velocity` and
/// `v:force`, 3 x |V|. Invalid once vertices are added or removed.
struct Motion {
  Eigen::Map<Mat3X> points;      // v
  Eigen::Map<Mat3X> velocities;  // u
  Eigen::Map<Mat3X> forces;      // lambda F_string + mu F_torque
  double mass;                   // m, of one vertex: 1 / |V|
};

/// Views of a mesh with at least one vertex; creates the two properties where they are missing.
Motion motion_of(TriMesh& mesh);

/// Sets velocities and forces to zero. [18]
void reset_motion(Motion& motion);

/// Displacement of the points in the time dt, first line of [22].
Mat3X displacement(const Motion& motion, double friction, double dt);

/// Advances the velocities by the time dt, second line of [22].
void accelerate(Motion& motion, double friction, double dt);

/// Maximum of |l - L| over the edges; `target_lengths` has one positive length per edge.
double max_length_error(const Eigen::Ref<const Mat3X>& points, const Adjacency& adjacency,
                        std::span<const double> target_lengths);

struct EvolutionOptions {
  DampedOptions damped = {};
  double altitude = 0;  // beta, weight of the altitude springs over the strings; the paper has none
  TimeStepOptions time_step = {};
  double tolerance = 1e-3;  // stop when max |l - L| is below this length; d_tolerance
  int max_steps = 400;      // accepted steps
};

/// The surface that the vertices move on; empty: they move freely in space.
struct EvolutionSurface {
  /// Removes from the forces (3 x |V|) the components along which vertices must not move.
  std::function<void(Mat3X& forces)> restrain = nullptr;
  /// The positions on the surface. Their normals tell the altitude springs which way is across.
  SurfacePositions* positions = nullptr;
  /// Filters each time step: the vertices go from v_{n+1/2} back to the surface, to v_{n+1}, and `positions`
  /// with them. Null: they leave it.
  Retraction* filter = nullptr;
};

/// One time step of Algorithm 2.
struct EvolutionStep {
  bool at_rest = false;      // no force and no velocity: no step was made
  AdaptedStep adapted = {};  // time, epsilon, and the tests that limited it
  double max_force = 0;      // l_force [21] at its start
};

/// Makes the largest step that passes the tests of [26] for the whole mesh at once, and updates forces,
/// points and velocities. The first three tests look at v_{n+1/2}, the last, of the area, at v_{n+1}. When
/// jammed or at rest, points and velocities stay. `last_factor` is the epsilon of the previous step.
EvolutionStep evolution_step(Motion& motion, const Adjacency& adjacency,
                             std::span<const double> target_lengths, const EvolutionOptions& options,
                             double last_factor, const EvolutionSurface& surface = {});

/// Result of Algorithm 2. The energy is that of the strings, relative to their rest lengths.
struct EvolutionResult : IntegrationResult {
  BoundCounts bound;            // of the accepted steps
  FailedTests jam;              // tests failed by the last candidate step, when jammed
  double time = 0;              // t_n, the sum of the time steps
  double max_length_error = 0;  // max |l - L| at the end, a length
  std::vector<TimeStepRecord> time_steps;
};

/// Algorithm 2: steps from rest until max |l - L| < tolerance (converged), no force acts (stalled), no time
/// step passes the tests (jammed), or the step limit. A mesh within the tolerance at the start stays
/// unchanged (the paper's loop makes one step before its test). With fixed connectivity the tolerance is
/// mostly out of reach, and another condition ends the run. `evaluations` counts all candidate steps. Throws
/// Error if the string tension or the friction is not positive.
///
/// Without a surface to filter to nothing keeps the mesh where it is. The strings alone fold it as they
/// shorten and lengthen edges, with torque or without, and next to a fold (theta near pi) the torque of [6]
/// is so large that it can move vertices by many edge lengths without failing a test of [26].
EvolutionResult evolve_damped(TriMesh& mesh, const Adjacency& adjacency,
                              std::span<const double> target_lengths, const EvolutionOptions& options,
                              const Observer& observer = nullptr, const EvolutionSurface& surface = {});

/// Moves relaxation.positions from rest toward an equilibrium on the surface. The forces are lambda * (minus
/// the gradient of relaxation.energy) + mu * F_torque, projected to the directions in which vertices may
/// move; forces, velocities and points are written to `mesh` (v:force, v:velocity). A vertex whose
/// displacement is shortened by the cap (IntegrationOptions::max_move) or the guards keeps the same part of
/// its velocity. Pre-condition: the mesh has the vertices of the relaxation.
///
/// Time step: dt = epsilon sqrt(m / lambda), in units of the period of a string of rest length 1, instead of
/// [24], which one short edge or one large force would drive to zero; the cap limits those vertices. epsilon
/// starts at 1/2, grows by 10% with every accepted step, and is halved when a step is rejected because it
/// raises the energy by more than the work of the torque. A rejected step also resets the velocities.
///
/// Every candidate step counts toward options.max_steps. The run ends at rest (stalled; over twenty
/// times options.window steps, because these steps are shorter than those of L-BFGS), at the step limit, or
/// jammed when no time step is accepted. Throws Error if the string tension or the friction is not positive,
/// NumericalError if the forces at the start are not finite.
IntegrationResult relax_damped(Relaxation& relaxation, TriMesh& mesh, const IntegrationOptions& options,
                               const DampedOptions& damped, const Observer& observer);

}  // namespace hooke
