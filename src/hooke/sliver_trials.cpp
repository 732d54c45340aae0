#include "hooke/sliver_trials.h"

#include <algorithm>
#include <optional>

#include "hooke/guards.h"
#include "hooke/least_angle.h"
#include "hooke/local_newton.h"
#include "hooke/parallel.h"

namespace hooke {
namespace {

/// The worst of what is to stay within limits in a patch, and what is beyond those of folds.
struct Worst {
  double alignment = 1, fold = 1, sagitta = 0, length = 0;
  int folded_faces = 0, folded_edges = 0;
};

bool is_within(const Worst& w, const Worst& limits) {
  return w.alignment >= limits.alignment && w.fold >= limits.fold && w.sagitta <= limits.sagitta &&
         w.length <= limits.length && w.folded_faces <= limits.folded_faces &&
         w.folded_edges <= limits.folded_edges;
}

/// A patch with the faces of one moment, and what it takes to move its vertices.
struct SettlingPatch {
  SettlingPatch(EdgePatch& p, std::vector<Triangle> faces, const EnergyTerms& terms,
                const GuardOptions& guard_options, const Retraction& of_mesh)
      : patch(p),
        connectivity(make_connectivity(static_cast<int>(p.sides.size()), std::move(faces))),
        targets(spread_target_lengths(connectivity, p.vertex_length)),
        energy(connectivity, targets, terms),
        guards(connectivity, targets, guard_options),
        retraction(of_mesh.surface(), p.constraints, of_mesh.options()),
        sweeps(plan_one_block(connectivity)) {}

  void sweep() {
    LocalNewton newton(relaxation);
    for (int v = 0; v < connectivity.vertex_count; ++v)
      if (patch.constraints.freedom[static_cast<size_t>(v)] != Freedom::fixed) newton.improve(v, {});
  }

  double greatest_cotangent() const {
    return hooke::greatest_cotangent(patch.placement.points, connectivity.faces);
  }

  double cost(const SliverTrialOptions& o) const {
    const Mat3X& points = patch.placement.points;
    double cost = 0;
    for (const Triangle& t : connectivity.faces) {
      const double angle = angle_with_cotangent(hooke::greatest_cotangent(points, t));
      const double lacks = std::max(0., o.fair_angle - angle);
      cost += lacks * lacks;
    }
    for (size_t e = 0; e < connectivity.edges.size(); ++e) {
      const auto& [a, b] = connectivity.edges[e];
      const double error = (points.col(b) - points.col(a)).norm() / targets.edge[e] - 1;
      cost += o.length_weight * error * error;
    }
    return cost;
  }

  Worst worst() const {
    const Placement& p = patch.placement;
    const auto& faces = connectivity.faces;
    Worst worst;
    for (const Triangle& t : faces) {
      const double alignment = face_alignment(p.points, p.normals, t);
      worst.alignment = std::min(worst.alignment, alignment);
      worst.folded_faces += alignment < guards.options().alignment;
    }
    for (size_t e = 0; e < connectivity.edges.size(); ++e) {
      const auto& [a, b] = connectivity.edges[e];
      const auto [f, g] = connectivity.edge_faces[e];
      const double length = (p.points.col(b) - p.points.col(a)).norm(), target = targets.edge[e];
      worst.length = std::max(worst.length, length / target);
      worst.sagitta = std::max(worst.sagitta, edge_sagitta(p.points, p.normals, {a, b}) / target);
      if (g < 0) continue;
      const double fold =
          cosine_between(p.points, faces[static_cast<size_t>(f)], faces[static_cast<size_t>(g)]);
      worst.fold = std::min(worst.fold, fold);
      worst.folded_edges += fold < guards.options().fold;
    }
    return worst;
  }

  EdgePatch& patch;
  Connectivity connectivity;
  TargetLengths targets;
  Energy energy;
  Guards guards;
  Retraction retraction;
  SweepPlan sweeps;
  Relaxation relaxation{connectivity, sweeps, patch.vertex_length, energy,
                        retraction,   guards, patch.placement};
};

struct Trial {
  EdgeChange change;
  EdgePatch patch;
  double gain;
};

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
        fresh_(static_cast<size_t>(t_.id_count()), 1) {
    guards_.sagitta = options.sagitta;
  }

  SliverChanges run(const Observer& observer) {
    for (int round = 0; round < options_.rounds; ++round) {
      const std::vector<int> faces = slivers();
      if (faces.empty()) break;
      fresh_.assign(static_cast<size_t>(t_.id_count()), 0);
      for (int f : faces) {
        if (observer && !observer({.step = changes_.count()})) return changes_;
        if (!is_sliver(f)) continue;
        if (std::optional<Trial> best = best_trial(f)) keep(*best);
      }
    }
    m_.retraction.count();
    return changes_;
  }

 private:
  double cotangent(int f) const {
    return greatest_cotangent(m_.placement.points, t_.faces()[static_cast<size_t>(f)]);
  }

  bool is_sliver(int f) const {
    return !t_.is_gone(f) && angle_with_cotangent(cotangent(f)) < options_.sliver_angle;
  }

  bool is_fresh(int f) const {
    return std::ranges::any_of(t_.faces()[static_cast<size_t>(f)],
                               [this](int v) { return fresh_[static_cast<size_t>(v)] != 0; });
  }

  /// The worst of them first.
  std::vector<int> slivers() const {
    std::vector<int> faces;
    for (int f = 0; f < t_.half_edge_count() / 3; ++f)
      if (is_sliver(f) && is_fresh(f)) faces.push_back(f);
    std::ranges::stable_sort(faces, std::ranges::greater(), [this](int f) { return cotangent(f); });
    const auto tries = static_cast<size_t>(
        std::clamp(static_cast<int>(options_.share * faces_), options_.least_tries, options_.most_tries));
    if (faces.size() > tries) faces.resize(tries);
    return faces;
  }

  /// What the guards allow, or what is there already: but no more folds than there are.
  Worst loosened(Worst now) const {
    now.alignment = std::min(now.alignment, guards_.alignment);
    now.fold = std::min(now.fold, guards_.fold);
    now.sagitta = std::max(now.sagitta, guards_.sagitta);
    now.length = std::max(now.length, options_.longest);
    return now;
  }

  std::optional<Trial> try_change(const EdgeChange& change) const {
    std::optional<EdgePatch> cut = cut_patch(m_.flipping(), change.half_edge, options_.rings, options_.most);
    if (!cut) return std::nullopt;
    Trial trial{change, std::move(*cut), 0};
    EdgePatch& patch = trial.patch;
    const SettlingPatch before(patch, patch.faces, terms_, guards_, m_.retraction);
    const double cost = before.cost(options_), cotangent = before.greatest_cotangent();
    const Worst limits = loosened(before.worst());
    SettlingPatch after(patch, change_patch(patch, change, m_.retraction.surface(), m_.retraction.options()),
                        terms_, guards_, m_.retraction);
    for (int sweep = 0; sweep < options_.sweeps; ++sweep) after.sweep();
    if (after.cost(options_) > cost + options_.hope) return std::nullopt;
    search_angles(after.relaxation, options_.search);
    trial.gain = cost - after.cost(options_);
    if (trial.gain < options_.gain || after.greatest_cotangent() > cotangent) return std::nullopt;
    if (!is_within(after.worst(), limits)) return std::nullopt;
    if (folds_at_rim(patch, after.connectivity.faces, m_.flipping(), guards_)) return std::nullopt;
    return trial;
  }

  /// Of equal ones the first.
  std::optional<Trial> best_trial(int face) const {
    const ChangeRules rules{.valence = options_.valence,
                            .splits = faces_ + 2 <= limits_.most,
                            .merges = faces_ - 2 >= limits_.least};
    const std::vector<EdgeChange> changes = changes_about(m_, face, rules);
    std::vector<std::optional<Trial>> trials(changes.size());
    parallel_for(changes.size(), 1, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) trials[i] = try_change(changes[i]);
    });
    std::optional<Trial> best;
    for (std::optional<Trial>& trial : trials)
      if (trial && (!best || trial->gain > best->gain)) best = std::move(trial);
    return best;
  }

  void keep(Trial& trial) {
    change_mesh(m_, trial.change, trial.patch);
    fresh_.resize(static_cast<size_t>(t_.id_count()), 0);
    for (int v : trial.patch.vertices) fresh_[static_cast<size_t>(v)] = 1;
    switch (trial.change.kind) {
      case ChangeKind::flip:
        ++changes_.flips;
        break;
      case ChangeKind::split:
        ++changes_.splits;
        faces_ += 2;
        break;
      case ChangeKind::merge:
        ++changes_.merges;
        faces_ -= 2;
        break;
    }
  }

  AdaptingMesh& m_;
  Triangulation& t_;
  const EnergyTerms& terms_;
  const SliverTrialOptions& options_;
  GuardOptions guards_;
  FaceCountLimits limits_;
  double faces_;
  std::vector<char> fresh_;  // per id: what is near it is to be looked at
  SliverChanges changes_;
};

}  // namespace

SliverChanges change_slivers(AdaptingMesh& m, const EnergyTerms& terms, const SliverTrialOptions& options,
                             const GuardOptions& guards, const FaceCountLimits& limits,
                             const Observer& observer) {
  return SliverTrials(m, terms, options, guards, limits).run(observer);
}

}  // namespace hooke
