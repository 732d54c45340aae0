// The damped evolution of a mesh under string and torque forces.
// "Hooke's Optimization for 3D triangular mesh", sections 4.1 to 4.3 and Algorithm 2, equations [17]-[26].
#pragma once

#include <functional>
#include <span>

#include "hooke/connectivity.h"
#include "hooke/mesh.h"
#include "hooke/time_step.h"

namespace hooke {

/// The constants of section 4.6. They expect a mesh whose target length is about 1: a string force is a
/// length, a torque force has no unit.
struct DampedOptions {
  double string = 2;       // string tension; lambda
  double torque = 1;       // torque coefficient; mu
  double friction = 1000;  // positive, one over a time; tau
  double tolerance = .05;  // stop when max |l - L| is below this length; d_tolerance
  int max_steps = 4000;    // accepted steps
  TimeStepOptions time_step = {};
};

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

/// Computes the forces at the present points. `target_lengths` has one positive length per edge.
void update_forces(Motion& motion, const Connectivity& connectivity, std::span<const double> target_lengths,
                   const DampedOptions& options);

/// The points after the time dt, first line of [22]. The motion stays as it is, so that a step can be tried.
Mat3X moved_points(const Motion& motion, double friction, double dt);

/// The velocities after the time dt, second line of [22].
void accelerate(Motion& motion, double friction, double dt);

/// One step of Algorithm 2.
struct DampedStep {
  int number = 0;               // of accepted steps, this one included
  bool at_rest = false;         // no force and no velocity: there was nothing to do
  AdaptedStep adapted;          // time, epsilon, the tests that bound it
  double max_length_error = 0;  // max |l - L| after the step, a length
};

/// Makes the largest step that the tests of [26] allow for the whole mesh at once: forces, points,
/// velocities. A jam or rest leaves points and velocities alone. `last_factor` is epsilon of the step before.
DampedStep damped_step(Motion& motion, const Connectivity& connectivity,
                       std::span<const double> target_lengths, const DampedOptions& options,
                       double last_factor);

/// Called after every accepted step; the mesh is valid then. Return false to stop.
using DampedObserver = std::function<bool(const DampedStep&)>;

enum class DampedStop {
  converged,   // max |l - L| < tolerance
  step_limit,  // max_steps were made
  jammed,      // no time step passes the tests
  at_rest,     // forces and velocities are exactly 0
  cancelled,   // by the observer
};

/// Steps by the test that set their length; a step that several tests cut counts for each.
struct BoundCounts {
  int angle = 0;
  int expansion = 0;
  int displacement = 0;
  int area_bound = 0;
  int none = 0;
};

struct DampedResult {
  DampedStop stop = DampedStop::converged;
  int steps = 0;                // accepted
  int rejected = 0;             // trials that failed a test
  BoundCounts bound;            // of the accepted steps
  FailedTests jam;              // what the last trial failed, when jammed
  double time = 0;              // t_n, the sum of the time steps
  double max_length_error = 0;  // max |l - L| at the end, a length
};

/// Algorithm 2: steps from rest until max |l - L| < tolerance. A mesh that fulfils this already is not
/// touched (the paper's loop makes one step before it looks). With fixed connectivity the tolerance may be
/// out of reach; then the step limit ends the run. Throws Error if the friction is not positive.
///
/// Nothing here holds the mesh on its surface. The strings alone fold it as they shorten and lengthen edges,
/// with torque or without, and next to a fold (theta near pi) the torque of [6] is so large that it can throw
/// vertices many lengths away without failing a test of [26].
DampedResult evolve_damped(TriMesh& mesh, const Connectivity& connectivity,
                           std::span<const double> target_lengths, const DampedOptions& options,
                           const DampedObserver& observer = {});

}  // namespace hooke
