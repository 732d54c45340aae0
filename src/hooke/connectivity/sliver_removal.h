// Slivers that neither springs nor a search for better places has mended: what can become of the edges
// nearby is tried, each change in a patch of its own, and the best one is kept.
#pragma once

#include <vector>

#include "hooke/connectivity/edge_trial.h"
#include "hooke/connectivity/flip_mode.h"
#include "hooke/integrator/guards.h"

namespace hooke {

struct SliverTrialOptions {
  /// Degrees, ascending: faces with a smaller angle are slivers, first those of less than the first angle.
  /// One threshold for all would let bad faces in each other's way wait for the mending of many fair ones.
  std::vector<double> sliver_angles = {25, 30, 35, 40};
  int rounds = 6;            // over the slivers that are left, for each of these angles
  double share = .01;        // of the faces: so many slivers are tried in a round, the worst first,
  int min_tries = 10;        // but so many in any case,
  int max_tries = 200;       // and no more than these
  double share_in_all = .1;  // of the faces: no more tries than so many in all rounds and stages, but ...
  int min_in_all = 60;       // ... so many in any case
  double noticed = .03;      // in target lengths; shorter moves are no reason to try edges again
  int valence = 9;           // of a vertex that gains edges
  size_t searched = 10;      // changes about a sliver, the best by then, that are tried to the end
  EdgeTrialOptions change{};
};

/// How many faces there may be in all.
struct FaceCountLimits {
  double least, most;
};

struct SliverChanges {
  int flips = 0, splits = 0, collapses = 0;
  int tries = 0;  // slivers whose edges were tried

  int count() const { return flips + splits + collapses; }
};

/// Every change lowers what its patch costs, keeps the least angle there, and adds nothing to what is beyond
/// the limits of alignment, folds and sagittas; no edge gets longer than the limit, or than the longest was.
/// An edge is tried again only when something has changed noticeably about it. The observer is called before
/// each sliver that is tried. Projections of trials are not counted. The mesh is not compact afterwards.
SliverChanges change_slivers(WorkingMesh& mesh, const EnergyTerms& terms, const SliverTrialOptions& options,
                             const GuardOptions& guards, const FaceCountLimits& limits,
                             const Observer& observer);

// Modes `flip` and `adapt`, last: slivers that are left are mended by other edges.

struct SliverRemovalOptions {
  int passes = 3;  // the vertices land after each, which may make slivers again
  SliverTrialOptions trials;
  double count_share = .02;  // of the wanted faces, by which their number may miss it in mode `adapt`
};

/// Changes the connectivity of the work about its slivers: in mode `flip` by flips only. Their neighbourhoods
/// settle; nothing else moves. Pre-condition: the vertices lie on the field of the input, see
/// Workspace::return_to_input().
SliverChanges remove_slivers(Workspace& work, ConnectivityMode mode, const EnergyTerms& terms,
                             const SliverRemovalOptions& options, const GuardOptions& guards,
                             double corner_angle, const Observer& observer);

}  // namespace hooke
