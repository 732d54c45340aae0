// Restarts: remeshes again where the result does not keep what it must keep of the input, and a small mesh
// several times with varied options while its angles are not good. On rough coarse surfaces, thin sheets in
// particular, the worst faces depend on small differences at the start.
#pragma once

#include "hooke/remesh/options.h"
#include "hooke/remesh/result.h"

namespace hooke {

struct RestartOptions {
  int max_runs = 12;            // maximum number of runs, including the first
  double max_faces = 4e4;       // maximum sum of the faces of all results; a larger mesh has one run
  int max_sliver_tests = 1000;  // sum of RemeshResult::sliver_tests after which further runs gain little
  PreservationOptions preservation = {};  // what a result must keep
  double good_angle = 30;  // degrees; minimum angle of a good result, or nearly the bound if that is smaller
};

/// The options for an effort level.
RestartOptions restart_options(Effort effort);

/// What is known of the input, so that it is not measured again.
struct KnownInput {
  const Quality* quality = nullptr;
  std::vector<int> tree_order = {};  // of the tree of its faces in memory order
};

/// Like remesh(), and measures the result. If it does not keep what it must keep of the input (see
/// measure/preservation.h), runs again: with the vertices held that it has lost, with varied options,
/// projected to the faces of the input, and at last, in the modes `fixed` and `flip`, with vertices put back
/// to where they were. In mode `adapt` the result may still not keep all: see RemeshResult::measures. In the
/// modes `flip` and `adapt` also runs a small mesh again while its minimum angle is small and its bound (see
/// angle_bound.h) larger. Keeps the result with the fewest flaws, then with the largest minimum angle. The
/// result of an interrupted restart is discarded.
RemeshResult remesh_with_restarts(TriMesh& mesh, MemoryOrder memory_order, const RemeshOptions& options,
                                  const RestartOptions& restarts = {}, const KnownInput& known = {},
                                  const Observer& observer = nullptr, Stopwatch* stopwatch = nullptr);

}  // namespace hooke
