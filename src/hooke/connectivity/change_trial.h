// Tries one change of an edge in a patch of its own: is the mesh better off there?
#pragma once

#include "hooke/connectivity/edge_changes.h"
#include "hooke/connectivity/patch_look.h"
#include "hooke/integrator/angle_search.h"

namespace hooke {

struct ChangeTrialOptions {
  double fair_margin =
      6;  // degrees; a face with less than so much more than a sliver costs the square of that
  double length_weight = 100;  // and an edge this many degrees squared times the square of l / L_e - 1
  double gain = 4;             // degrees squared; least fall of the cost of a patch for a change to be kept
  double hope = 500;           // degrees squared; greatest rise of it by a change and its springs to go on
  int rings = 2;               // around an edge, within which the vertices settle
  size_t most = 100;           // vertices that settle: no edge is tried about which there are more
  int sweeps = 3;              // of Newton's method vertex by vertex, for them to settle
  // What a change may leave, besides what is there; alignment and fold are those of the guards.
  double sagitta = .5;    // of an edge, over its target length
  double longest = 1.7;   // edge over its target length
  double area_loss = .2;  // of covered surface, over a mean target length squared: rims of thin sheets stay
  AngleSearchOptions search{.edge_error_limit = 1.2, .sagitta = 0, .max_rounds = 12};  // after the sweeps
};

struct ChangeTrial {
  EdgeChange change{};
  EdgePatch patch{};
  PatchLook before{};
  Connectivity connectivity{};  // of the patch once it is changed, as are these:
  TargetLengths targets{};
  double gain = 0;          // degrees squared: fall of the cost so far
  bool is_hopeful = false;  // is it worth going on or, at the end, worth keeping?
};

/// The mesh is only looked at: several changes may be tried at the same time. Keeps references to the mesh,
/// the terms and the options. Projections are not counted.
class ChangeTrials {
 public:
  ChangeTrials(const AdaptingMesh& mesh, const EnergyTerms& terms, const ChangeTrialOptions& options,
               const GuardOptions& guards);

  /// Faces with a smaller angle than this, degrees, are slivers from now on.
  void begin_with(double sliver_angle);

  /// Changes the patch and lets its springs settle. Pre-condition: begin_with().
  ChangeTrial begin(const EdgeChange& change) const;

  /// Searches for better places, and judges the outcome: it is to lower what the patch costs, to keep the
  /// least angle there and the surface that the faces cover, and to add nothing to what is beyond the limits.
  void finish(ChangeTrial& trial) const;

 private:
  ChangeTrial cut(const EdgeChange& change) const;
  PatchLook look_before(const EdgePatch& patch) const;
  template <typename Relax>
  PatchLook relax(ChangeTrial& trial, const Relax& body) const;
  double gain(const PatchLook& before, const PatchLook& now) const;

  const AdaptingMesh& m_;
  const EnergyTerms& terms_;
  const ChangeTrialOptions& options_;
  GuardOptions guards_;
  PatchLimits limits_{};
};

}  // namespace hooke
