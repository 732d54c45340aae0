#include "hooke/integrator/damped_relaxation.h"

#include <cmath>

#include "hooke/core/error.h"
#include "hooke/integrator/landing.h"
#include "hooke/springs/forces.h"

namespace hooke {
namespace {

constexpr double growth = 1.1;  // of epsilon after an accepted step
constexpr double floor = 1e-9;  // of epsilon; jammed below
constexpr int patience = 10;    // damped steps for one of L-BFGS, when rest is looked for

/// Forces at a placement, split because only the torque has no potential.
struct Forces {
  double energy = 0;
  Mat3X total;   // lambda * (minus the gradient of the energy) + mu * torque, in the tangent space
  Mat3X torque;  // mu * torque
};

void compute(const Relaxation& r, const Placement& at, const DampedOptions& damped, Forces& forces) {
  forces.energy = r.energy(at, &forces.total);
  forces.total *= -damped.string;
  forces.torque.resize(3, at.points.cols());
  if (damped.torque != 0)
    torque_forces(at.points, r.connectivity, forces.torque);
  else
    forces.torque.setZero();
  forces.torque *= damped.torque;
  forces.total += forces.torque;  // [17]
  r.retraction.constrain(at, forces.total);
}

/// Takes from the velocities the share of the way that the vertices were not let go.
void slow_down(Motion& motion, const Mat3X& wanted, const Mat3X& granted) {
  for (Eigen::Index v = 0; v < wanted.cols(); ++v) {
    const double way = wanted.col(v).norm(), part = granted.col(v).norm();
    if (part < way) motion.velocities.col(v) *= part / way;
  }
}

void keep_in_tangent_space(const Relaxation& r, Motion& motion) {
  Mat3X velocities = motion.velocities;
  r.retraction.constrain(r.placement, velocities);
  motion.velocities = velocities;
}

RestDetector rest_detector(IntegrationOptions options) {
  options.window *= patience;
  return RestDetector(options);
}

}  // namespace

IntegrationResult relax_damped(Relaxation& r, TriMesh& mesh, const IntegrationOptions& options,
                               const DampedOptions& damped, const Observer& observer) {
  require_valid(damped);
  Motion motion = motion_of(mesh);
  come_to_rest(motion);
  motion.points = r.placement.points;
  const double base = std::sqrt(motion.mass / damped.string);
  double factor = first_factor;  // epsilon
  IntegrationResult result;
  RestDetector rest = rest_detector(options);
  Forces forces, trial_forces;
  Placement trial;

  compute(r, r.placement, damped, forces);
  if (!std::isfinite(forces.energy) || !forces.total.allFinite())
    throw NumericalError("the forces on the mesh are not finite; check its points and target lengths");
  motion.forces = forces.total;
  result.evaluations = 1;
  rest.at_rest(forces.energy);
  result.reason = StopReason::step_limit;

  while (result.evaluations < options.max_steps) {
    const double dt = factor * base;
    const Mat3X wanted = displacement(motion, damped.friction, dt);
    Mat3X granted = wanted;
    cap_displacement(r.vertex_length, options.max_move, granted);
    result.held_back +=
        static_cast<long long>(r.guards.step(r.retraction, r.placement, granted, trial).size());
    compute(r, trial, damped, trial_forces);
    ++result.evaluations;

    const double torque_work = forces.torque.cwiseProduct(trial.points - r.placement.points).sum();
    if (!(damped.string * (trial_forces.energy - forces.energy) <= torque_work)) {
      motion.velocities.setZero();
      factor /= 2;
      if (factor >= floor) continue;
      result.reason = StopReason::jammed;
      break;
    }
    accelerate(motion, damped.friction, dt);
    slow_down(motion, wanted, granted);
    std::swap(r.placement, trial);
    std::swap(forces, trial_forces);
    keep_in_tangent_space(r, motion);
    motion.points = r.placement.points;
    motion.forces = forces.total;
    factor *= growth;
    ++result.steps;
    if (observer && !observer({"", 0, result.steps, forces.energy})) {
      result.reason = StopReason::interrupted;
      break;
    }
    if (rest.at_rest(forces.energy)) {
      result.reason = StopReason::stalled;
      break;
    }
  }
  settle(r.guards, r.retraction, r.placement);
  compute(r, r.placement, damped, forces);
  motion.points = r.placement.points;
  motion.forces = forces.total;
  result.energy = forces.energy;
  return result;
}

}  // namespace hooke
