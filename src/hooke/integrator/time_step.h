// How far the damped evolution may go at once: the base step and the four tests that a step must pass.
// "Hooke's Optimization for 3D triangular mesh", section 4.3, equations [19]-[21] and [24]-[26].
#pragma once

#include <functional>

#include "hooke/core/types.h"
#include "hooke/mesh/adjacency.h"

namespace hooke {

/// Thresholds of the tests of [26].
struct TimeStepOptions {
  double angle = .9;          // least cosine between a face's normals before and after; delta_angle
  double expansion = .01;     // greatest relative change of a face's area; delta_expansion
  double displacement = .01;  // greatest move of a vertex, times the shortest edge; xi, eta_n = xi l_edge
  double area_bound = 0;      // least area of a face after the step, a squared length; delta_bound
  double floor = 1e-12;  // jammed when only shorter time steps pass; a time, 1e-9 / tau at the usual friction
};

/// What the base step is made of.
struct StepScales {
  double edge = 0;      // shortest edge of positive length; l_edge [19]
  double velocity = 0;  // greatest speed; l_velocity [20]
  double force = 0;     // greatest force; l_force [21]
};

/// Edges of length 0 are left out of [19]: they would forbid every step for good.
/// Without an edge of positive length `edge` is infinite.
StepScales step_scales(const Eigen::Ref<const Mat3X>& points, const Eigen::Ref<const Mat3X>& velocities,
                       const Eigen::Ref<const Mat3X>& forces, const Adjacency& adjacency);

/// omega: the longest time in which no vertex, were it free, would travel further than the shortest edge.
/// [24] Not finite when nothing moves and nothing pulls. `mass` is the mass of one vertex.
double base_step(const StepScales& scales, double mass);

/// The tests of [26] that failed.
struct FailedTests {
  bool angle = false;
  bool expansion = false;
  bool displacement = false;
  bool area_bound = false;

  bool any() const { return angle || expansion || displacement || area_bound; }
};

/// Steps by the test that set their length; a step that several tests cut counts for each.
struct BoundCounts {
  int angle = 0;
  int expansion = 0;
  int displacement = 0;
  int area_bound = 0;
  int none = 0;

  void add(const FailedTests& bound);
  BoundCounts& operator+=(const BoundCounts& other);
};

/// Tests the move of the points from `before` to `after`. A value that is not a number fails.
/// A face that was degenerate before is exempt from the three face tests: it has no normal and no area to
/// compare with, and one such face in the input would reject all steps.
FailedTests test_step(const Eigen::Ref<const Mat3X>& before, const Eigen::Ref<const Mat3X>& after,
                      const Adjacency& adjacency, double shortest_edge, const TimeStepOptions& options);

/// What became of one search for a time step.
struct AdaptedStep {
  double time = 0;    // dt_n = omega_n epsilon_n [25]
  double factor = 0;  // epsilon_n
  int rejected = 0;   // trials that failed a test
  FailedTests
      bound;  // tests that failed in the last rejected trial: they set the step; none if it grew freely
  bool jammed = false;  // the time fell below the floor: there is no step
};

/// epsilon_{-1} of [26].
inline constexpr double first_factor = .5;

/// Tries 2, 1, 1/2, 1/4 ... times the factor of the last step and takes the first that passes. [25][26]
/// `trial(dt)` makes the step in a copy and tests it. Jams when the time falls below `floor`; `bound` is
/// empty then if the first time was below it already.
AdaptedStep adapt_step(double base, double last_factor, double floor,
                       const std::function<FailedTests(double time)>& trial);

}  // namespace hooke
