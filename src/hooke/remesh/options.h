// What a run is to do: the options of all its parts, and what an effort stands for.
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

enum class Refit { each, once };

/// What brings the springs to their equilibrium; untangling and polishing go vertex by vertex.
enum class IntegratorKind {
  lbfgs,   // minimises the energy
  damped,  // follows the evolution [17], torque included
};

/// What a mesh that is good already must not lose. Equal edges and great angles are two aims: a mesh whose
/// angles are all good could pay for the one with the other.
struct NearRegularOptions {
  double angle = 35;        // degrees; a mesh is near-regular if no angle is below ...
  double deviation = .25;   // ... and the standard deviation of l / L_e is at most this part of its mean
  double max_travel = .19;  // of its target length, that a vertex of a near-regular mesh may travel
};

struct RemeshOptions {
  ConnectivityMode connectivity = ConnectivityMode::fixed;
  FlipOptions flips = flip_options(Effort::standard);  // in the modes `flip` and `adapt`
  AdaptOptions adaptation;                             // in mode `adapt`
  bool map = false;                                    // RemeshResult::map is wanted
  IntegratorKind integrator = IntegratorKind::lbfgs;
  IntegrationOptions integration{.energy_drop = 4e-3};  // its energy_drop is that of mode `fixed`
  LbfgsOptions lbfgs;
  DampedOptions damped;
  double altitude = 1;  // beta, weight of the altitude springs against the strings
  GuardOptions guards;
  NearRegularOptions near_regular;  // in mode `fixed`
  UntangleOptions untangle;
  AngleSpringOptions angle_springs;
  bool polish_angles = true;
  AngleSearchOptions search;     // after the polish
  SliverRemovalOptions slivers;  // after that, in the modes `flip` and `adapt`
  FilterOptions filter{.max_deviation = .35};
  // Of the field: before each outer iteration, where the guards guard_limited the last; or once, which
  // `adapt` always does.
  Refit refit = Refit::each;
  RetractionOptions retraction{.tolerance = 1e-5, .lazy = 2};
  ConstraintOptions constraints;
  double tolerance = 1e-3;   // of every edge, in parts of its target length
  int max_outer = 6;         // outer iterations
  double outer_drop = 5e-3;  // stalled when an outer iteration lowers the energy by less than this part ...
  /// ... or comes to rest where guards held back no more of the vertices' steps than this part, all trials
  /// counted.
  double guard_limited = 2.5e-4;
};

/// Sets the counts and limits that an effort stands for, in the connectivity mode of the options. `standard`
/// is what the options are by default.
void set_effort(RemeshOptions& options, Effort effort);

}  // namespace hooke
