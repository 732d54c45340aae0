#include "hooke/damped_evolution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "hooke/error.h"
#include "hooke/forces.h"

namespace hooke {
namespace {

double max_length_error(const Motion& motion, const Connectivity& c, std::span<const double> target_lengths) {
  double worst = 0;
  for (std::size_t e = 0; e < c.edges.size(); ++e) {
    const auto [i, j] = c.edges[e];
    const double l = (motion.points.col(j) - motion.points.col(i)).norm();
    worst = std::max(worst, std::abs(l - target_lengths[e]));
  }
  return worst;
}

void count(BoundCounts& counts, const FailedTests& bound) {
  counts.angle += bound.angle;
  counts.expansion += bound.expansion;
  counts.displacement += bound.displacement;
  counts.area_bound += bound.area_bound;
  counts.none += !bound.any();
}

}  // namespace

Motion motion_of(TriMesh& mesh) {
  assert(mesh.n_vertices() > 0);
  const VProp<Vec3> velocity(mesh, velocity_property);
  const VProp<Vec3> force(mesh, force_property);
  return {positions(mesh), as_matrix(mesh, velocity), as_matrix(mesh, force),
          1 / static_cast<double>(mesh.n_vertices())};
}

void come_to_rest(Motion& motion) {
  motion.velocities.setZero();
  motion.forces.setZero();
}

void update_forces(Motion& motion, const Connectivity& c, std::span<const double> target_lengths,
                   const DampedOptions& options) {
  Mat3X torques(3, motion.points.cols());
  string_forces(motion.points, c, target_lengths, motion.forces);
  torque_forces(motion.points, c, torques);
  motion.forces = options.string * motion.forces + options.torque * torques;  // [17]
}

Mat3X moved_points(const Motion& motion, double tau, double dt) {
  const auto& U = motion.velocities;
  const auto& F = motion.forces;
  const double m = motion.mass;
  Mat3X X = motion.points;
  X += U * (-std::expm1(-tau * dt) / tau) + F * (dt * dt / (2 * m));  // [22]
  return X;
}

void accelerate(Motion& motion, double tau, double dt) {
  auto& U = motion.velocities;
  U = U * std::exp(-tau * dt) + motion.forces * (dt / motion.mass);  // [22]
}

DampedStep damped_step(Motion& motion, const Connectivity& c, std::span<const double> target_lengths,
                       const DampedOptions& options, double last_factor) {
  update_forces(motion, c, target_lengths, options);
  const StepScales scales = step_scales(motion.points, motion.velocities, motion.forces, c);
  DampedStep step;
  const double base = base_step(scales, motion.mass);
  step.at_rest = !std::isfinite(base);
  if (!step.at_rest) {
    Mat3X X;
    step.adapted = adapt_step(base, last_factor, options.time_step.floor, [&](double dt) {
      X = moved_points(motion, options.friction, dt);
      return test_step(motion.points, X, c, scales.edge, options.time_step);
    });
    if (!step.adapted.jammed) {
      motion.points = X;
      accelerate(motion, options.friction, step.adapted.time);
    }
  }
  step.max_length_error = max_length_error(motion, c, target_lengths);
  return step;
}

DampedResult evolve_damped(TriMesh& mesh, const Connectivity& c, std::span<const double> target_lengths,
                           const DampedOptions& options, const DampedObserver& observer) {
  if (!(options.friction > 0))
    throw Error(fmt::format("friction {}; expected a positive number", options.friction));
  Motion motion = motion_of(mesh);
  come_to_rest(motion);
  DampedResult result;
  result.max_length_error = max_length_error(motion, c, target_lengths);
  const auto stopped = [&](DampedStop reason) {
    result.stop = reason;
    return result;
  };
  double factor = first_factor;
  while (!(result.max_length_error < options.tolerance)) {
    if (result.steps >= options.max_steps) return stopped(DampedStop::step_limit);
    DampedStep step = damped_step(motion, c, target_lengths, options, factor);
    if (step.at_rest) return stopped(DampedStop::at_rest);
    result.rejected += step.adapted.rejected;
    if (step.adapted.jammed) {
      result.jam = step.adapted.bound;
      return stopped(DampedStop::jammed);
    }
    step.number = ++result.steps;
    factor = step.adapted.factor;
    count(result.bound, step.adapted.bound);
    result.time += step.adapted.time;
    result.max_length_error = step.max_length_error;
    if (observer && !observer(step)) return stopped(DampedStop::cancelled);
  }
  return stopped(DampedStop::converged);
}

}  // namespace hooke
