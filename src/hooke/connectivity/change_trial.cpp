#include "hooke/connectivity/change_trial.h"

#include <cmath>
#include <numeric>

#include "hooke/integrator/local_newton.h"

namespace hooke {
namespace {

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.) / static_cast<double>(values.size());
}

}  // namespace

ChangeTrials::ChangeTrials(const AdaptingMesh& mesh, const EnergyTerms& terms,
                           const ChangeTrialOptions& options, const GuardOptions& guards)
    : m_(mesh), terms_(terms), options_(options), guards_(guards) {
  guards_.sagitta = options.sagitta;
}

void ChangeTrials::begin_with(double sliver_angle) {
  limits_ = {sliver_angle + options_.fair_margin, guards_.alignment, guards_.fold, options_.sagitta,
             options_.longest};
}

PatchLook ChangeTrials::look_before(const EdgePatch& patch) const {
  const Connectivity c = make_connectivity(static_cast<int>(patch.sides.size()), patch.faces);
  return look_at(patch.placement, c, spread_target_lengths(c, patch.vertex_length), limits_);
}

/// A vertex that comes or goes takes no credit for the number of its edges.
double ChangeTrials::gain(const PatchLook& before, const PatchLook& now) const {
  const double errors_before = before.length_errors,
               errors_now =
                   now.length_errors * static_cast<double>(before.edges) / static_cast<double>(now.edges);
  return before.angle_cost - now.angle_cost + options_.length_weight * (errors_before - errors_now);
}

ChangeTrial ChangeTrials::cut(const EdgeChange& change) const {
  ChangeTrial trial;
  trial.change = change;
  std::optional<EdgePatch> patch = cut_patch(m_.flipping(), change.half_edge, options_.rings, options_.most);
  if (!patch) return trial;
  trial.patch = std::move(*patch);
  trial.before = look_before(trial.patch);
  trial.connectivity =
      make_connectivity(static_cast<int>(trial.patch.sides.size()),
                        change_patch(trial.patch, change, m_.retraction.surface(), m_.retraction.options()));
  trial.targets = spread_target_lengths(trial.connectivity, trial.patch.vertex_length);
  trial.is_hopeful = true;
  return trial;
}

/// Calls body(relaxation) and looks at the patch again.
template <typename Relax>
PatchLook ChangeTrials::relax(ChangeTrial& trial, const Relax& body) const {
  Energy energy(trial.connectivity, trial.targets, terms_);
  Guards guards(trial.connectivity, trial.targets, guards_);
  Retraction retraction(m_.retraction.surface(), trial.patch.constraints, m_.retraction.options());
  const SweepPlan sweeps = plan_one_block(trial.connectivity);
  Relaxation r{trial.connectivity, sweeps, trial.patch.vertex_length, energy,
               retraction,         guards, trial.patch.placement};
  body(r);
  return look_at(trial.patch.placement, trial.connectivity, trial.targets, limits_);
}

ChangeTrial ChangeTrials::begin(const EdgeChange& change) const {
  ChangeTrial trial = cut(change);
  if (!trial.is_hopeful) return trial;
  const PatchLook now = relax(trial, [this](Relaxation& r) {
    for (int sweep = 0; sweep < options_.sweeps; ++sweep) local_newton_sweep(r, {}, {});
  });
  trial.gain = gain(trial.before, now);
  trial.is_hopeful = trial.gain >= -options_.hope;
  return trial;
}

void ChangeTrials::finish(ChangeTrial& trial) const {
  const PatchLook& before = trial.before;
  const PatchLook after = relax(trial, [this](Relaxation& r) { search_angles(r, options_.search); });
  trial.gain = gain(before, after);
  trial.is_hopeful =
      trial.gain >= options_.gain && after.cotangent <= before.cotangent &&
      before.area - after.area <= options_.area_loss * std::pow(mean_of(trial.patch.vertex_length), 2) &&
      is_no_worse(after.excess, before.excess) &&
      !folds_at_rim(trial.patch, trial.connectivity.faces, m_.flipping(), guards_);
}

}  // namespace hooke
