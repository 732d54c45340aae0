// Angle springs on the worst corners, after the equilibrium of the edges: the modified Hooke's law's
// repulsive branch on corner angles below a threshold that rises in stages.
#pragma once

#include "hooke/integrator/relaxation.h"

namespace hooke {

struct TargetLengths;

struct AngleSpringOptions {
  double first_threshold = 20;     // degrees; at least least angle + margin
  double margin = 2;               // degrees
  double threshold_step = 2;       // degrees per stage
  double min_step = 1;             // degrees; to which steps halve where a stage or the next costs too much
  double last_threshold = 32;      // degrees
  double first_weight = 30;        // w of the first stage
  double weight = 100;             // w of the others
  int sweeps = 3;                  // per stage, of Newton's method vertex by vertex
  int rings = 2;                   // around the faces below the threshold, within which vertices move
  double rest = .01;               // of a target length; what moves less in a sweep sits out the next
  double edge_error_limit = .995;  // of l / L_e's deviation at the start, for all stages after the first kept
  double keep_within = .1;         // degrees below the best angle at which a later state is still kept
};

struct AngleSpringResult {
  int stages = 0;
  int sweeps = 0;
  double min_angle_before = 0, min_angle_after = 0;    // degrees
  double edge_error_before = 0, edge_error_after = 0;  // standard deviation of l / L_e
  bool interrupted = false;
};

/// Raises the least angle as long as the standard deviation of l / L_e stays within its limit.
AngleSpringResult raise_angles(Relaxation& relaxation, const TargetLengths& targets,
                               const AngleSpringOptions& options, const Observer& observer);

/// Standard deviation of l / L_e over the edges.
double relative_edge_deviation(const Mat3X& points, const std::vector<Edge>& edges,
                               const TargetLengths& targets);

}  // namespace hooke
