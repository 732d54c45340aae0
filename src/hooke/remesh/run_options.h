// The options of all steps of a run, as the connectivity mode and the effort set them.
#pragma once

#include "hooke/connectivity/adaptation.h"
#include "hooke/connectivity/flip_mode.h"
#include "hooke/connectivity/sliver_removal.h"
#include "hooke/core/stopwatch.h"
#include "hooke/filter/retraction.h"
#include "hooke/geometry/local_shape.h"
#include "hooke/integrator/angle_search.h"
#include "hooke/integrator/angle_springs.h"
#include "hooke/integrator/integration.h"
#include "hooke/remesh/options.h"
#include "hooke/remesh/result.h"

namespace hooke {

/// Preserves near-regular meshes: equal edges and large angles are two objectives, and a mesh whose angles
/// are all good could lose angles for more equal edges. A mesh is near-regular if it is within both `angle`
/// and `deviation`.
struct NearRegular {
  static constexpr double angle = 35;       // degrees; minimum angle of a near-regular mesh
  static constexpr double deviation = .25;  // maximum standard deviation of l / L_e, over its mean
  static constexpr double deviation_of_squares =
      .03;  // with rest ratios: about rhombi with a corner of 83 degrees
  /// With rest ratios angles above this share of their least rest angle may get less.
  static constexpr double share_of_rest_angle = .8;
  static constexpr double max_travel = .19;  // of a vertex of a near-regular mesh, in its target lengths
};

/// Passes of sliver removal; each ends with a projection to the input surface, which may create new slivers.
inline constexpr int sliver_passes = 3;

struct RunOptions {
  /// Those of the effort and the mode that are chosen.
  explicit RunOptions(const RemeshOptions& options);

  RemeshOptions chosen;
  FlipOptions flips;                                    // in the modes `flip` and `adapt`
  AdaptOptions adaptation;                              // in mode `adapt`
  IntegrationOptions integration{.energy_drop = 4e-3};  // energy_drop: in mode `fixed`
  ShapeLimits limits;
  AngleSpringOptions angle_springs;
  AngleSearchOptions search;  // after the angle springs
  SliverOptions slivers;      // after the search, in the modes `flip` and `adapt`
  RetractionOptions retraction{.tolerance = 1e-5, .lazy = 2};
  int max_outer = 6;         // maximum number of outer iterations
  double outer_drop = 5e-3;  // stalled when an outer iteration lowers the energy by less than this share
  /// Also stalled when an iteration comes to rest and guards limited no more than this share of all evaluated
  /// vertex steps.
  double guard_limited = 2.5e-4;
};

}  // namespace hooke
