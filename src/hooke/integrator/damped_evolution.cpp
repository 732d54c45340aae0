#include "hooke/integrator/damped_evolution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "hooke/core/error.h"
#include "hooke/core/parallel.h"
#include "hooke/filter/retraction.h"
#include "hooke/geometry/triangle.h"
#include "hooke/integrator/final_projection.h"
#include "hooke/integrator/relaxation.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/springs/energy.h"
#include "hooke/springs/forces.h"
#include "hooke/springs/hooke_law.h"

namespace hooke {
namespace {

const Mat3X* normals_of(const EvolutionSurface& surface) {
  return surface.positions ? &surface.positions->normals : nullptr;
}

void update_forces(Motion& motion, const Adjacency& c, std::span<const double> target_lengths,
                   const EvolutionOptions& options, const EvolutionSurface& surface) {
  Mat3X forces(3, motion.points.cols()), torques(3, motion.points.cols());
  string_forces(motion.points, c, target_lengths, forces);
  torque_forces(motion.points, c, torques);
  if (options.altitude > 0)
    add_altitude_forces(motion.points, normals_of(surface), c, target_lengths, options.altitude, forces);
  forces = options.damped.string * forces + options.damped.torque * torques;  // [17]
  if (surface.restrain) surface.restrain(forces);
  motion.forces = forces;
}

bool has_small_face(const Mat3X& points, const Adjacency& c, double area) {
  return std::ranges::any_of(c.faces,
                             [&](const Triangle& t) { return !(face_shape(points, t).area > area); });
}

}  // namespace

void require_valid(const DampedOptions& options) {
  if (!(options.friction > 0))
    throw Error(fmt::format("friction {}; expected a positive number", options.friction));
  if (!(options.string > 0))
    throw Error(fmt::format("string tension {}; expected a positive number", options.string));
}

Motion motion_of(TriMesh& mesh) {
  assert(mesh.n_vertices() > 0);
  const VProp<Vec3> velocity(mesh, velocity_property);
  const VProp<Vec3> force(mesh, force_property);
  return {vertex_points(mesh), as_matrix(mesh, velocity), as_matrix(mesh, force),
          1 / static_cast<double>(mesh.n_vertices())};
}

void reset_motion(Motion& motion) {
  motion.velocities.setZero();
  motion.forces.setZero();
}

Mat3X displacement(const Motion& motion, double tau, double dt) {
  const auto& U = motion.velocities;
  const auto& F = motion.forces;
  const double m = motion.mass;
  return U * (-std::expm1(-tau * dt) / tau) + F * (dt * dt / (2 * m));  // [22]
}

void accelerate(Motion& motion, double tau, double dt) {
  auto& U = motion.velocities;
  U = U * std::exp(-tau * dt) + motion.forces * (dt / motion.mass);  // [22]
}

double max_length_error(const Eigen::Ref<const Mat3X>& points, const Adjacency& c,
                        std::span<const double> target_lengths) {
  double worst = 0;
  for (size_t e = 0; e < c.edges.size(); ++e) {
    const double l = (points.col(c.edges[e][1]) - points.col(c.edges[e][0])).norm();
    worst = std::max(worst, std::abs(l - target_lengths[e]));
  }
  return worst;
}

EvolutionStep evolution_step(Motion& motion, const Adjacency& c, std::span<const double> target_lengths,
                             const EvolutionOptions& options, double last_factor,
                             const EvolutionSurface& surface) {
  update_forces(motion, c, target_lengths, options, surface);
  const StepScales scales = step_scales(motion.points, motion.velocities, motion.forces, c);
  const double base = base_step(scales, motion.mass);
  if (!std::isfinite(base)) return {.at_rest = true};
  Mat3X X;
  SurfacePositions filtered;
  EvolutionStep step{.max_force = scales.force};
  step.adapted = adapt_step(base, last_factor, options.time_step.floor, [&](double dt) {
    X = motion.points + displacement(motion, options.damped.friction, dt);  // v_{n+1/2}
    FailedTests failed = test_step(motion.points, X, c, scales.edge, options.time_step);
    if (failed.any() || !surface.filter) return failed;
    surface.filter->step(*surface.positions, X - surface.positions->points, filtered);  // v_{n+1}
    failed.area_bound = has_small_face(filtered.points, c, options.time_step.area_bound);
    return failed;
  });
  if (step.adapted.jammed) return step;
  if (surface.filter) {
    motion.points = filtered.points;
    std::swap(*surface.positions, filtered);
  } else {
    motion.points = X;
  }
  accelerate(motion, options.damped.friction, step.adapted.time);
  return step;
}

EvolutionResult evolve_damped(TriMesh& mesh, const Adjacency& c, std::span<const double> target_lengths,
                              const EvolutionOptions& options, const Observer& observer,
                              const EvolutionSurface& surface) {
  require_valid(options.damped);
  Motion motion = motion_of(mesh);
  reset_motion(motion);
  EvolutionResult result;
  TimeStepRecord now;
  const auto measure = [&] {
    now.max_length_error = result.max_length_error = max_length_error(motion.points, c, target_lengths);
    now.string_energy = result.energy = string_energy(motion.points, c, target_lengths);
    if (options.altitude > 0)
      now.altitude_energy = altitude_energy(motion.points, normals_of(surface), c, target_lengths);
    now.kinetic_energy = .5 * motion.mass * motion.velocities.squaredNorm();
  };
  const auto stopped = [&](StopReason reason) {
    result.reason = reason;
    return result;
  };
  measure();
  double factor = initial_factor;
  while (!(result.max_length_error < options.tolerance)) {
    if (result.steps >= options.max_steps) return stopped(StopReason::step_limit);
    const EvolutionStep step = evolution_step(motion, c, target_lengths, options, factor, surface);
    if (step.at_rest) return stopped(StopReason::stalled);
    result.evaluations += step.adapted.rejected + !step.adapted.jammed;
    if (step.adapted.jammed) {
      result.jam = step.adapted.bound;
      return stopped(StopReason::jammed);
    }
    ++result.steps;
    factor = step.adapted.factor;
    result.bound.add(step.adapted.bound);
    result.time += step.adapted.time;
    measure();
    now.step = result.steps;
    now.time = result.time;
    now.step_time = step.adapted.time;
    now.bound = step.adapted.bound;
    now.max_force = step.max_force;
    result.time_steps.push_back(now);
    if (observer && !observer({"", 0, result.steps, result.energy})) return stopped(StopReason::interrupted);
  }
  return stopped(StopReason::converged);
}

namespace {

constexpr double growth = 1.1;            // factor of epsilon after an accepted step
constexpr double floor = 1e-9;            // of epsilon; a run below it is jammed
constexpr int steps_per_lbfgs_step = 20;  // in the test for rest

/// Forces at the current positions. The torque is kept apart because it has no potential.
struct Forces {
  double energy = 0;
  Mat3X total;   // lambda * (minus the gradient of the energy) + mu * torque, in the tangent space
  Mat3X torque;  // mu * torque
};

void compute(Relaxation& r, const SurfacePositions& at, const DampedOptions& damped, Forces& forces) {
  forces.energy = r.energy(at.points, at.normals, &forces.total);
  forces.total *= -damped.string;
  forces.torque.resize(3, at.points.cols());
  if (damped.torque != 0)
    torque_forces(at.points, r.adjacency, forces.torque);
  else
    forces.torque.setZero();
  forces.torque *= damped.torque;
  forces.total += forces.torque;  // [17]
  r.retraction.constrain(at, forces.total);
}

/// Scales the velocity of each vertex by the part of its displacement that the cap and the guards allowed.
void scale_velocities(Motion& motion, const Mat3X& proposed, const Mat3X& allowed) {
  for (Eigen::Index v = 0; v < proposed.cols(); ++v) {
    const double proposed_length = proposed.col(v).norm(), allowed_length = allowed.col(v).norm();
    if (allowed_length < proposed_length) motion.velocities.col(v) *= allowed_length / proposed_length;
  }
}

void keep_in_tangent_space(const Relaxation& r, Motion& motion) {
  Mat3X velocities = motion.velocities;
  r.retraction.constrain(r.positions, velocities);
  motion.velocities = velocities;
}

RestDetector rest_detector(IntegrationOptions options) {
  options.window *= steps_per_lbfgs_step;
  return RestDetector(options);
}

}  // namespace

IntegrationResult relax_damped(Relaxation& r, TriMesh& mesh, const IntegrationOptions& options,
                               const DampedOptions& damped, const Observer& observer) {
  require_valid(damped);
  Motion motion = motion_of(mesh);
  reset_motion(motion);
  motion.points = r.positions.points;
  const double base = std::sqrt(motion.mass / damped.string);
  double factor = initial_factor;  // epsilon
  IntegrationResult result;
  RestDetector rest = rest_detector(options);
  Forces forces, candidate_forces;
  SurfacePositions candidate;

  compute(r, r.positions, damped, forces);
  if (!std::isfinite(forces.energy) || !forces.total.allFinite())
    throw NumericalError("the forces on the mesh are not finite; check its points and target lengths");
  motion.forces = forces.total;
  result.evaluations = 1;
  rest.at_rest(forces.energy);
  result.reason = StopReason::step_limit;

  while (result.evaluations < options.max_steps) {
    const double dt = factor * base;
    const Mat3X proposed = displacement(motion, damped.friction, dt);
    Mat3X allowed = proposed;
    cap_displacement(r.vertex_length, options.max_move, allowed);
    result.limited_steps +=
        static_cast<long long>(r.guards.step(r.retraction, r.positions, allowed, candidate).size());
    compute(r, candidate, damped, candidate_forces);
    ++result.evaluations;

    const double torque_work = forces.torque.cwiseProduct(candidate.points - r.positions.points).sum();
    if (!(damped.string * (candidate_forces.energy - forces.energy) <= torque_work)) {
      motion.velocities.setZero();
      factor /= 2;
      if (factor >= floor) continue;
      result.reason = StopReason::jammed;
      break;
    }
    accelerate(motion, damped.friction, dt);
    scale_velocities(motion, proposed, allowed);
    std::swap(r.positions, candidate);
    std::swap(forces, candidate_forces);
    keep_in_tangent_space(r, motion);
    motion.points = r.positions.points;
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
  project_drifted(r.guards, r.retraction, r.positions);
  compute(r, r.positions, damped, forces);
  motion.points = r.positions.points;
  motion.forces = forces.total;
  result.energy = forces.energy;
  return result;
}

}  // namespace hooke
