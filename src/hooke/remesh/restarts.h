// Small meshes again from other starts. On rough coarse surfaces, thin sheets above all, small differences at
// the start decide what becomes of the worst faces; what can be paid for is tried more than once.
#pragma once

#include "hooke/remesh/options.h"
#include "hooke/remesh/result.h"

namespace hooke {

struct RestartOptions {
  int most = 12;           // attempts
  double max_faces = 4e4;  // of the results of all attempts together; a larger mesh is made once
  int max_tries = 1000;    // no further attempt after so many sliver_tries: there is little to be gained
  double good_angle = 30;  // degrees; a result with a smaller one, which might be larger, is not good
};

/// The options that an effort stands for.
RestartOptions restart_options(Effort effort);

/// remesh(), in the modes `flip` and `adapt` again from other starts while the result is not good: while
/// faces are flipped, more pairs cross than before, or the least angle is small and its bound (see
/// crease_bound.h) is not. The best result is kept: by flipped faces and crossings, then by the least angle.
/// An interrupted attempt after the first counts for nothing.
RemeshResult remesh_with_restarts(TriMesh& mesh, MemoryOrder memory_order, const RemeshOptions& options,
                                  const RestartOptions& restarts = {}, const Observer& observer = nullptr,
                                  Stopwatch* stopwatch = nullptr);

}  // namespace hooke
