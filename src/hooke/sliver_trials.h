// Slivers that neither springs nor a search for better places has mended: what can become of the edges
// nearby is tried, each change in a patch of its own, and the best one is kept.
#pragma once

#include <vector>

#include "hooke/angle_search.h"
#include "hooke/edge_changes.h"

namespace hooke {

struct SliverTrialOptions {
  /// Degrees, ascending: faces with a smaller angle are slivers, first those of less than the first angle.
  /// One threshold for all would let bad faces in each other's way wait for the mending of many fair ones.
  std::vector<double> sliver_angles = {25, 30, 35, 40};
  double fair_margin = 6;  // degrees; a face with less than so much more costs the square of what it lacks
  double length_weight = 100;  // and an edge this many degrees squared times the square of l / L_e - 1
  double gain = 4;             // degrees squared; least fall of the cost of a patch for a change to be kept
  double hope = 500;           // degrees squared; greatest rise of it by a change and its springs to go on
  int rounds = 6;              // over the slivers that are left, for each of these angles
  double share = .01;          // of the faces: so many slivers are tried in a round, the worst first,
  int least_tries = 10;        // but so many in any case,
  int most_tries = 200;        // and no more than these
  double share_in_all = .1;    // of the faces: no more tries than so many in all rounds and stages, but ...
  int least_in_all = 60;       // ... so many in any case
  double noticed = .03;        // in target lengths; shorter moves are no reason to try edges again
  int rings = 2;               // around an edge, within which the vertices settle
  size_t most = 100;           // vertices that settle: no edge is tried about which there are more
  int sweeps = 3;              // of Newton's method vertex by vertex, for them to settle
  // What a change may leave, besides what is there; alignment and fold are those of the guards.
  double sagitta = .5;   // of an edge, over its target length
  double longest = 1.7;  // edge over its target length
  double area_loss =
      .2;           // of the surface that faces cover, over a mean target length squared: thin rims stay
  int valence = 9;  // of a vertex that gains edges
  AngleSearchOptions search{.edge_error_limit = 1.2, .sagitta = 0, .max_rounds = 12};  // after the sweeps
};

/// How many faces there may be in all.
struct FaceCountLimits {
  double least, most;
};

struct SliverChanges {
  int flips = 0, splits = 0, merges = 0;
  int tries = 0;  // slivers whose edges were tried

  int count() const { return flips + splits + merges; }
};

/// Every change lowers what its patch costs, keeps the least angle there, and adds nothing to what is beyond
/// the limits of alignment, folds and sagittas; no edge gets longer than the limit, or than the longest was.
/// An edge is tried again only when something has changed noticeably about it. The observer is called before
/// each sliver that is tried. Projections of trials are not counted. The mesh is not compact afterwards.
SliverChanges change_slivers(AdaptingMesh& mesh, const EnergyTerms& terms, const SliverTrialOptions& options,
                             const GuardOptions& guards, const FaceCountLimits& limits,
                             const Observer& observer);

}  // namespace hooke
