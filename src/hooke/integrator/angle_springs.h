// Angle springs at the worst corners, applied after the equilibrium of the edges: the repulsive branch of the
// modified Hooke's law acts on corner angles below a threshold that rises in stages.
#pragma once

#include "hooke/core/types.h"
#include "hooke/integrator/integration.h"

namespace hooke {

struct Relaxation;
struct TargetLengths;

struct AngleSpringOptions {
  double first_threshold = 20;                // degrees; at least the minimum angle + margin
  double margin = 2;                          // degrees
  double threshold_step = 2;                  // degrees between stages; halved when a stage costs too much
  double min_step = 1;                        // degrees; no shorter threshold steps
  double last_threshold = 32;                 // degrees
  static constexpr double first_weight = 30;  // weight w of the first stage
  static constexpr double weight = 100;       // weight w of the other stages
  int sweeps = 3;                             // Gauss-Seidel sweeps per stage
  double rest = .01;            // in target lengths; a vertex that moves less skips the next sweep
  double edge_error_limit = 1;  // maximal standard deviation of l / L_e, relative to its start
  double keep_within = .1;      // degrees below the best angle at which a later state is still kept
};

/// Raises the minimum angle in stages while the standard deviation of l / L_e stays within its limit.
/// Restores the best state and the energy terms.
AngleSpringResult raise_angles(Relaxation& relaxation, const TargetLengths& targets,
                               const AngleSpringOptions& options, const Observer& observer);

/// Standard deviation of l / L_e over the edges.
double relative_edge_deviation(const Mat3X& points, const std::vector<Edge>& edges,
                               const TargetLengths& targets);

}  // namespace hooke
