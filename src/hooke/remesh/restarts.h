// Restarts: remeshes a small mesh several times with varied options and keeps the best result. On rough
// coarse surfaces, thin sheets in particular, the worst faces depend on small differences at the start.
#pragma once

#include "hooke/remesh/options.h"
#include "hooke/remesh/result.h"

namespace hooke {

struct RestartOptions {
  int max_runs = 12;            // maximum number of runs, including the first
  double max_faces = 4e4;       // maximum sum of the faces of all results; a larger mesh has one run
  int max_sliver_tests = 1000;  // sum of RemeshResult::sliver_tests after which further runs gain little
  double good_angle = 30;  // degrees; minimum angle of a good result, or nearly the bound if that is smaller
};

/// The options for an effort level.
RestartOptions restart_options(Effort effort);

/// Like remesh(), but in the modes `flip` and `adapt` restarted while the result is not good: while it has
/// flipped faces, more intersecting pairs of faces than the input, or a small minimum angle whose bound (see
/// angle_bound.h) is larger. Keeps the best result, by flipped faces and intersections, then by the minimum
/// angle. The result of an interrupted restart is discarded.
RemeshResult remesh_with_restarts(TriMesh& mesh, MemoryOrder memory_order, const RemeshOptions& options,
                                  const RestartOptions& restarts = {}, const Observer& observer = nullptr,
                                  Stopwatch* stopwatch = nullptr);

}  // namespace hooke
