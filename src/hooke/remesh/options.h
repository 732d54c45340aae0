// The options of a remeshing run, including those of all its steps, and their presets for the effort levels.
#pragma once

#include "hooke/connectivity/adaptation.h"
#include "hooke/connectivity/flip_mode.h"
#include "hooke/connectivity/sliver_removal.h"
#include "hooke/constraints/constraints.h"
#include "hooke/filter/retraction.h"
#include "hooke/filter/surface_field.h"
#include "hooke/integrator/angle_search.h"
#include "hooke/integrator/angle_springs.h"
#include "hooke/integrator/damped_evolution.h"
#include "hooke/integrator/guards.h"
#include "hooke/integrator/lbfgs.h"
#include "hooke/integrator/untangle.h"

namespace hooke {

/// The method that finds the equilibrium of the springs. Untangling and angle optimisation work vertex by
/// vertex with either.
enum class IntegratorKind {
  lbfgs,   // minimises the energy
  damped,  // follows the evolution [17], torque included
};

/// Preserves near-regular meshes: equal edges and large angles are two objectives, and a mesh whose angles
/// are all good could lose angles for more equal edges. A mesh is near-regular if it is within both `angle`
/// and `deviation`.
struct NearRegularOptions {
  double angle = 35;        // degrees; minimum angle of a near-regular mesh
  double deviation = .25;   // maximum standard deviation of l / L_e, over its mean
  double max_travel = .19;  // maximum travel of a vertex of a near-regular mesh, in its target lengths
};

struct RemeshOptions {
  ConnectivityMode connectivity = ConnectivityMode::fixed;
  FlipOptions flips = flip_options(Effort::standard);  // in the modes `flip` and `adapt`
  AdaptOptions adaptation;                             // in mode `adapt`
  bool map = false;                                    // compute RemeshResult::map
  IntegratorKind integrator = IntegratorKind::lbfgs;
  IntegrationOptions integration{.energy_drop = 4e-3};  // energy_drop: in mode `fixed`
  LbfgsOptions lbfgs;
  DampedOptions damped;
  double altitude = 1;  // beta, weight of the altitude springs relative to the strings
  GuardOptions guards;
  NearRegularOptions near_regular;  // in mode `fixed`
  UntangleOptions untangle;
  AngleSpringOptions angle_springs;
  bool polish_angles = true;     // run angle springs, search and sliver removal
  AngleSearchOptions search;     // after the angle springs
  SliverRemovalOptions slivers;  // after the search, in the modes `flip` and `adapt`
  FilterOptions filter{.max_deviation = .35};
  Refit refit = Refit::each;
  RetractionOptions retraction{.tolerance = 1e-5, .lazy = 2};
  ConstraintOptions constraints;
  double tolerance = 1e-3;   // converged when max |l - L_e| / L_e is below this
  int max_outer = 6;         // maximum number of outer iterations
  double outer_drop = 5e-3;  // stalled when an outer iteration lowers the energy by less than this share
  /// Also stalled when an iteration comes to rest and guards limited no more than this share of all evaluated
  /// vertex steps.
  double guard_limited = 2.5e-4;
};

/// Sets the options for an effort level, in the connectivity mode of the options. `standard` is the default
/// of mode `fixed`.
void set_effort(RemeshOptions& options, Effort effort);

}  // namespace hooke
