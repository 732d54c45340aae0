#include "hooke/sliver_trials.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include "hooke/guards.h"
#include "hooke/least_angle.h"
#include "hooke/local_newton.h"
#include "hooke/parallel.h"
#include "hooke/patch_look.h"

namespace hooke {
namespace {

struct Trial {
  EdgeChange change;
  EdgePatch patch;
  double gain;
};

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.) / static_cast<double>(values.size());
}

class SliverTrials {
 public:
  SliverTrials(AdaptingMesh& mesh, const EnergyTerms& terms, const SliverTrialOptions& options,
               const GuardOptions& guards, const FaceCountLimits& limits)
      : m_(mesh),
        t_(mesh.triangulation),
        terms_(terms),
        options_(options),
        guards_(guards),
        limits_(limits),
        faces_(static_cast<double>(t_.faces().size())),
        most_tries_(std::max(options.least_in_all, static_cast<int>(options.share_in_all * faces_))) {
    guards_.sagitta = options.sagitta;
  }

  SliverChanges run(const Observer& observer) {
    for (double angle : options_.sliver_angles) {
      begin_with(angle);
      for (int round = 0; round < options_.rounds && try_slivers(observer); ++round) continue;
      if (interrupted_) break;
    }
    m_.retraction.count();
    return changes_;
  }

 private:
  void begin_with(double sliver_angle) {
    sliver_cotangent_ = 1 / std::tan(sliver_angle * std::numbers::pi / 180);
    limits_of_patch_ = {sliver_angle + options_.fair_margin, guards_.alignment, guards_.fold,
                        options_.sagitta, options_.longest};
    tried_at_.clear();
  }

  /// One round. False if there was nothing to try, or if it was interrupted.
  bool try_slivers(const Observer& observer) {
    const int most = std::min(
        std::clamp(static_cast<int>(options_.share * faces_), options_.least_tries, options_.most_tries),
        most_tries_ - changes_.tries);
    int tries = most;
    for (int f : slivers()) {
      if (tries == 0) break;
      if (!is_sliver(f)) continue;
      const std::vector<int> edges = untried_edges_about(f);
      if (edges.empty()) continue;
      interrupted_ = observer && !observer({.step = changes_.count()});
      if (interrupted_) return false;
      --tries;
      ++changes_.tries;
      if (std::optional<Trial> best = best_trial(edges)) keep(*best);
    }
    return tries < most;
  }

  double cotangent(int f) const {
    return greatest_cotangent(m_.placement.points, t_.faces()[static_cast<size_t>(f)]);
  }

  bool is_sliver(int f) const { return !t_.is_gone(f) && cotangent(f) > sliver_cotangent_; }

  /// The worst of them first.
  std::vector<int> slivers() const {
    std::vector<int> faces;
    for (int f = 0; f < t_.half_edge_count() / 3; ++f)
      if (is_sliver(f)) faces.push_back(f);
    std::ranges::stable_sort(faces, std::ranges::greater(), [this](int f) { return cotangent(f); });
    return faces;
  }

  /// Those about which something has changed noticeably since they were tried last.
  std::vector<int> untried_edges_about(int face) {
    tried_at_.resize(static_cast<size_t>(t_.half_edge_count()), -1);
    changed_at_.resize(static_cast<size_t>(t_.id_count()), 0);
    std::vector<int> edges = inner_edges_about(t_, face);
    std::erase_if(edges, [this](int h) {
      const int changed =
          std::max(changed_at_[static_cast<size_t>(t_.from(h))], changed_at_[static_cast<size_t>(t_.to(h))]);
      return tried_at_[static_cast<size_t>(h)] >= changed;
    });
    return edges;
  }

  PatchLook look_before(const EdgePatch& patch) const {
    const Connectivity c = make_connectivity(static_cast<int>(patch.sides.size()), patch.faces);
    return look_at(patch.placement, c, spread_target_lengths(c, patch.vertex_length), limits_of_patch_);
  }

  /// A vertex that comes or goes takes no credit for the number of its edges.
  double gain(const PatchLook& before, const PatchLook& now) const {
    const double errors_before = before.length_errors,
                 errors_now =
                     now.length_errors * static_cast<double>(before.edges) / static_cast<double>(now.edges);
    return before.angle_cost - now.angle_cost + options_.length_weight * (errors_before - errors_now);
  }

  /// Nothing where the change is not worth it.
  std::optional<Trial> try_change(const EdgeChange& change) const {
    std::optional<EdgePatch> cut = cut_patch(m_.flipping(), change.half_edge, options_.rings, options_.most);
    if (!cut) return std::nullopt;
    Trial trial{change, std::move(*cut), 0};
    EdgePatch& patch = trial.patch;
    const PatchLook before = look_before(patch);
    std::vector<Triangle> faces =
        change_patch(patch, change, m_.retraction.surface(), m_.retraction.options());
    const Connectivity c = make_connectivity(static_cast<int>(patch.sides.size()), std::move(faces));
    const TargetLengths targets = spread_target_lengths(c, patch.vertex_length);
    Energy energy(c, targets, terms_);
    Guards guards(c, targets, guards_);
    Retraction retraction(m_.retraction.surface(), patch.constraints, m_.retraction.options());
    const SweepPlan sweeps = plan_one_block(c);
    Relaxation r{c, sweeps, patch.vertex_length, energy, retraction, guards, patch.placement};
    for (int sweep = 0; sweep < options_.sweeps; ++sweep) local_newton_sweep(r, {}, {});
    if (gain(before, look_at(patch.placement, c, targets, limits_of_patch_)) < -options_.hope)
      return std::nullopt;
    search_angles(r, options_.search);
    const PatchLook after = look_at(patch.placement, c, targets, limits_of_patch_);
    trial.gain = gain(before, after);
    if (trial.gain < options_.gain || after.cotangent > before.cotangent) return std::nullopt;
    if (before.area - after.area > options_.area_loss * std::pow(mean_of(patch.vertex_length), 2))
      return std::nullopt;
    if (!is_no_worse(after.excess, before.excess)) return std::nullopt;
    if (folds_at_rim(patch, c.faces, m_.flipping(), guards_)) return std::nullopt;
    return trial;
  }

  /// Of equal ones the first.
  std::optional<Trial> best_trial(const std::vector<int>& edges) {
    const ChangeRules rules{.valence = options_.valence,
                            .splits = faces_ + 2 <= limits_.most,
                            .merges = faces_ - 2 >= limits_.least};
    std::vector<EdgeChange> changes;
    for (int h : edges) {
      const std::vector<EdgeChange> allowed = allowed_changes(m_, h, rules);
      changes.insert(changes.end(), allowed.begin(), allowed.end());
      tried_at_[static_cast<size_t>(h)] = changes_.count();
    }
    std::vector<std::optional<Trial>> trials(changes.size());
    parallel_for(changes.size(), 1, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) trials[i] = try_change(changes[i]);
    });
    std::optional<Trial> best;
    for (std::optional<Trial>& trial : trials)
      if (trial && (!best || trial->gain > best->gain)) best = std::move(trial);
    return best;
  }

  /// The corners of the faces of its edge, what a merge joins anew, and those that have come so far, all in
  /// all, that it is noticed.
  std::vector<int> vertices_changed_by(const Trial& trial) {
    const int h = trial.change.half_edge;
    std::vector<int> vertices = {t_.from(h), t_.to(h), t_.apex(h), t_.apex(t_.twin(h))};
    if (trial.change.kind == ChangeKind::merge)
      for (int end : {t_.from(h), t_.to(h)})
        for (int v : t_.neighbours(end)) vertices.push_back(v);
    unnoticed_.resize(static_cast<size_t>(t_.id_count()), 0);
    for (Eigen::Index i = 0; i < trial.patch.placement.points.cols(); ++i) {
      const int v = trial.patch.vertices[static_cast<size_t>(i)];
      if (v < 0) continue;  // is to come
      double& moved = unnoticed_[static_cast<size_t>(v)];
      moved += (trial.patch.placement.points.col(i) - m_.placement.points.col(v)).norm();
      if (moved <= options_.noticed * m_.vertex_length[static_cast<size_t>(v)]) continue;
      moved = 0;
      vertices.push_back(v);
    }
    return vertices;
  }

  void keep(Trial& trial) {
    std::vector<int> changed = vertices_changed_by(trial);
    change_mesh(m_, trial.change, trial.patch);
    switch (trial.change.kind) {
      case ChangeKind::flip:
        ++changes_.flips;
        break;
      case ChangeKind::split:
        ++changes_.splits;
        changed.push_back(trial.patch.vertices.back());
        faces_ += 2;
        break;
      case ChangeKind::merge:
        ++changes_.merges;
        faces_ -= 2;
        break;
    }
    changed_at_.resize(static_cast<size_t>(t_.id_count()), 0);
    for (int v : changed) changed_at_[static_cast<size_t>(v)] = changes_.count();
  }

  AdaptingMesh& m_;
  Triangulation& t_;
  const EnergyTerms& terms_;
  const SliverTrialOptions& options_;
  GuardOptions guards_;
  FaceCountLimits limits_;
  PatchLimits limits_of_patch_;
  double faces_;
  const int most_tries_;
  double sliver_cotangent_ = 0;
  std::vector<int> tried_at_;      // per half-edge that stands for its edge: changes so far; -1 for never
  std::vector<int> changed_at_;    // per id: changes so far, when the last one changed what is about it
  std::vector<double> unnoticed_;  // per id: the length of its moves since changed_at_ was set for them
  SliverChanges changes_;
  bool interrupted_ = false;
};

}  // namespace

SliverChanges change_slivers(AdaptingMesh& m, const EnergyTerms& terms, const SliverTrialOptions& options,
                             const GuardOptions& guards, const FaceCountLimits& limits,
                             const Observer& observer) {
  return SliverTrials(m, terms, options, guards, limits).run(observer);
}

}  // namespace hooke
