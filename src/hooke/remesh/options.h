// What a user chooses of a remeshing run.
#pragma once

#include <optional>

#include "hooke/connectivity/connectivity_mode.h"
#include "hooke/constraints/constraint_options.h"
#include "hooke/filter/filter.h"
#include "hooke/integrator/integration.h"

namespace hooke {

/// How much time to spend on better triangles.
enum class Effort { fast, standard, thorough };

/// The method that finds the equilibrium of the springs. Untangling and angle optimisation work vertex by
/// vertex with either.
enum class IntegratorKind {
  lbfgs,   // minimises the energy
  damped,  // follows the evolution [17], torque included
};

/// Lengths and angles as their members say; what is not given is as the effort says, see run_options.h.
struct RemeshOptions {
  ConnectivityMode connectivity = ConnectivityMode::fixed;
  Effort effort = Effort::standard;
  bool map = false;  // compute RemeshResult::map
  IntegratorKind integrator = IntegratorKind::lbfgs;
  DampedOptions damped;
  double altitude = 1;        // beta, weight of the altitude springs relative to the strings
  bool polish_angles = true;  // run angle springs, search and sliver removal
  FilterOptions filter{.max_deviation = .35};
  Refit refit = Refit::each;
  ConstraintOptions constraints;
  /// In mode `adapt`: how short target lengths may be in narrow regions between creases or boundaries, in the
  /// unit of the points, 0: as given; and by how much they grow away from these, over the distance.
  double min_length = 0, gradation = .3;
  double tolerance = 1e-3;       // converged when max |l - L_e| / L_e is below this
  std::optional<int> max_outer;  // maximum number of outer iterations
  std::optional<int> max_steps;  // maximum number of steps of the integrator in each of them
};

}  // namespace hooke
