// Options, progress and results of the integrators, as far as users see them.
#pragma once

#include <functional>

namespace hooke {

enum class StopReason {
  converged,    // every edge within the tolerance of its target length
  stalled,      // at rest: the energy no longer falls
  step_limit,   // the allowed number of steps or evaluations is used up
  jammed,       // no step is accepted any more, or none that gets anywhere
  interrupted,  // the observer asked to stop
};

/// Progress of the optimization as reported to the observer. The stage is one of "untangle", "adapt", "flow",
/// "springs", "flips", "relax", "polish", "mend" and "paper".
struct Progress {
  const char* stage = "";
  int outer = 0;
  int step = 0;
  double energy = 0;
};

/// Called after every step, and after tries of one that are rejected; returns false to stop and keep what has
/// been reached.
using Observer = std::function<bool(const Progress&)>;

/// The constants of [17], section 4.6. They assume target lengths of about 1: a string force is a length, a
/// torque force has no unit.
struct DampedOptions {
  double string = 2;       // lambda, the string tension; positive
  double torque = 1;       // mu, the torque coefficient
  double friction = 1000;  // tau, one over a time; positive
};

struct IntegrationOptions {
  int max_steps = 2000;       // evaluations of the energy (lbfgs) or time steps (damped)
  double energy_drop = 2e-3;  // relative fall of the energy over the window, below which it is at rest
  int window = 3;             // steps
  static constexpr double max_move = 2;  // of a vertex in one step, in its target lengths
};

struct IntegrationResult {
  int steps = 0;
  int evaluations = 0;          // of the energy or the forces
  double energy = 0;            // at the end
  long long limited_steps = 0;  // vertex displacements shortened by the guards
  StopReason reason = StopReason::stalled;
};

/// What raise_angles() did.
struct AngleSpringResult {
  int stages = 0;
  int sweeps = 0;
  double min_angle_before = 0, min_angle_after = 0;    // degrees
  double edge_error_before = 0, edge_error_after = 0;  // standard deviation of l / L_e
  bool interrupted = false;
};

}  // namespace hooke
