// Slivers that neither springs nor a search for better places has mended: what can become of the edges
// nearby is tried, each change in a patch of its own, and the best one is kept.
#pragma once

#include "hooke/angle_search.h"
#include "hooke/edge_changes.h"

namespace hooke {

struct SliverTrialOptions {
  double sliver_angle = 30;    // degrees; faces with a smaller angle are slivers
  double fair_angle = 36;      // degrees; a smaller angle costs the square of what it lacks
  double length_weight = 100;  // degrees squared; of the square of l / L_e - 1 in that cost
  double gain = 4;             // degrees squared; least fall of the cost of a patch for a change to be kept
  double hope = 500;           // degrees squared; greatest rise of it by a change and its springs to go on
  double share = .01;    // of the faces: for so many slivers changes are tried in a round, the worst first,
  int least_tries = 10;  // but for so many in any case,
  int most_tries = 200;  // and for no more than these
  int rounds = 4;        // each but the first only near what the one before has changed
  int rings = 2;         // around an edge, within which the vertices settle
  size_t most = 100;     // vertices that settle: no edge is tried about which there are more
  int sweeps = 3;        // of Newton's method vertex by vertex, for them to settle
  // What may be left of a change, unless it was worse before; alignment and fold are those of the guards.
  double sagitta = .5;   // greatest of an edge, over its target length
  double longest = 1.7;  // edge over its target length
  int valence = 9;       // greatest of a vertex
  AngleSearchOptions search{.edge_error_limit = 1.2, .max_rounds = 12};  // after the sweeps
};

/// How many faces there may be in all.
struct FaceCountLimits {
  double least, most;
};

struct SliverChanges {
  int flips = 0, splits = 0, merges = 0;

  int count() const { return flips + splits + merges; }
};

/// Every change raises the angles of its patch and does not lower the least of them. The observer is called
/// before each sliver. Projections of trials are not counted. The mesh is not compact afterwards.
SliverChanges change_slivers(AdaptingMesh& mesh, const EnergyTerms& terms, const SliverTrialOptions& options,
                             const GuardOptions& guards, const FaceCountLimits& limits,
                             const Observer& observer);

}  // namespace hooke
