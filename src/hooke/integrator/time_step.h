// The time step of the damped evolution: the base step, the four tests that limit it, and its record.
// "Hooke's Optimization for 3D triangular mesh", section 4.3, equations [19]-[21] and [24]-[26].
#pragma once

#include <functional>

#include "hooke/core/types.h"
#include "hooke/mesh/adjacency.h"

namespace hooke {

/// Thresholds of the tests of [26].
struct TimeStepOptions {
  double angle = .9;          // delta_angle: minimum cosine between a face's normals before and after
  double expansion = .01;     // delta_expansion: maximum relative change of a face's area
  double displacement = .01;  // xi: maximum displacement over the shortest edge; eta_n = xi l_edge
  double area_bound = 0;      // delta_bound: minimum area of a face after the step, a squared length
  static constexpr double floor =
      1e-12;  // time below which the search is jammed; 1e-9 / tau at the usual friction
};

/// The scales that determine the base step.
struct StepScales {
  double edge = 0;      // l_edge [19]: shortest edge of positive length
  double velocity = 0;  // l_velocity [20]: maximum speed
  double force = 0;     // l_force [21]: maximum force
};

/// Edges of length 0 are left out of [19], because they would forbid every step. Without an edge of positive
/// length `edge` is infinite.
StepScales step_scales(const Eigen::Ref<const Mat3X>& points, const Eigen::Ref<const Mat3X>& velocities,
                       const Eigen::Ref<const Mat3X>& forces, const Adjacency& adjacency);

/// omega, the longest time in which no vertex, if unconstrained, moves farther than the shortest edge. [24]
/// Not finite when velocities and forces are zero. `mass` is that of one vertex.
double base_step(const StepScales& scales, double mass);

/// The tests of [26] that failed.
struct FailedTests {
  bool angle = false;
  bool expansion = false;
  bool displacement = false;
  bool area_bound = false;

  bool any() const { return angle || expansion || displacement || area_bound; }
};

/// Numbers of steps by the test that limited them; a step limited by several tests counts for each.
struct BoundCounts {
  int angle = 0;
  int expansion = 0;
  int displacement = 0;
  int area_bound = 0;
  int none = 0;  // steps that no test limited

  void add(const FailedTests& bound);
  BoundCounts& operator+=(const BoundCounts& other);
};

/// Tests the displacement of the points from `before` to `after`. NaN fails. A face that was degenerate
/// before is exempt from the three face tests: it has no normal and no area to compare with, and one such
/// face in the input would reject all steps.
FailedTests test_step(const Eigen::Ref<const Mat3X>& before, const Eigen::Ref<const Mat3X>& after,
                      const Adjacency& adjacency, double shortest_edge, const TimeStepOptions& options);

/// Result of one search for a time step.
struct AdaptedStep {
  double time = 0;      // dt_n = omega_n epsilon_n [25]
  double factor = 0;    // epsilon_n
  int rejected = 0;     // candidates that failed a test
  FailedTests bound;    // tests failed by the last rejected candidate; none if none was rejected
  bool jammed = false;  // the time fell below the floor: there is no step
};

/// epsilon_{-1} of [26].
inline constexpr double initial_factor = .5;

/// Tests 2, 1, 1/2, 1/4 ... times the last factor and returns the first that passes. [25][26] `test(dt)`
/// makes the step on a copy and returns the failed tests. Jams when the time falls below `floor`; `bound` is
/// then empty if the first time was already below it.
AdaptedStep adapt_step(double base, double last_factor, double floor,
                       const std::function<FailedTests(double time)>& test);

/// The state after a time step, in the units of the evolution.
struct TimeStepRecord {
  int outer = 0;                // outer iteration, from 1
  int step = 0;                 // n + 1
  double time = 0;              // t_{n+1}
  double step_time = 0;         // dt_n
  FailedTests bound;            // the tests that limited dt_n
  double string_energy = 0;     // sum of U(l; L) / L^2
  double altitude_energy = 0;   // sum of U(h; h0) / L_f^2, without the weight beta
  double kinetic_energy = 0;    // sum of m u^2 / 2
  double max_force = 0;         // l_force [21] at the start of the step
  double max_length_error = 0;  // max |l - L|
};

}  // namespace hooke
