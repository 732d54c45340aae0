// Sliver removal, the last step of the modes `flip` and `adapt`: for faces that vertex motion could not
// improve, all changes of the edges nearby are tested, each in its own patch, and the best one is applied.
#pragma once

#include <vector>

#include "hooke/connectivity/connectivity_mode.h"
#include "hooke/connectivity/edge_trial.h"
#include "hooke/integrator/integration.h"

namespace hooke {

struct SliverOptions {
  /// Degrees, ascending: faces with a smaller minimum angle are slivers, one stage for each angle. With a
  /// single angle the worst faces would have to wait for the removal of many mild slivers.
  std::vector<double> sliver_angles = {25, 30, 35, 40};
  int rounds = 6;             // over the remaining slivers, per stage
  double share_in_all = .03;  // maximum number of slivers tested in all passes, as a share of the faces
  int min_in_all = 120;       // lower limit of that maximum
  size_t searched = 10;       // candidates per sliver, the best after relaxation, that are tested to the end
};

/// Limits on the total number of faces.
struct FaceCountLimits {
  double min, max;
};

struct SliverChanges {
  int flips = 0, splits = 0, collapses = 0;
  int tested = 0;  // slivers whose edges were tested

  int count() const { return flips + splits + collapses; }
};

/// Changes edges near slivers. Each change lowers the cost of its patch, keeps the minimum angle there and
/// increases no violation of the limits of alignment, fold, sagitta and length, see CandidateEvaluator. An
/// edge is tested again only after its neighbourhood has changed noticeably. The observer is called before
/// each sliver that is tested. Projections in the tests are not counted. The mesh is not compact afterwards.
/// `tested_before`: number of slivers that earlier passes have tested.
SliverChanges change_slivers(WorkingMesh& mesh, const EnergyTerms& terms, const SliverOptions& options,
                             const ShapeLimits& limits, const FaceCountLimits& allowed_faces,
                             int tested_before, const Observer& observer);

/// Changes the connectivity of the workspace near its slivers, in mode `flip` by flips only. Only vertices
/// near the changed edges move. `tested_before`: number of slivers that earlier passes have tested.
/// Pre-condition: the vertices lie on the field of the input, see Workspace::return_to_input().
SliverChanges remove_slivers(Workspace& work, ConnectivityMode mode, const EnergyTerms& terms,
                             const SliverOptions& options, const ShapeLimits& limits, int tested_before,
                             const Observer& observer);

}  // namespace hooke
