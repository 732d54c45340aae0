#include "hooke/connectivity/sliver_removal.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "hooke/connectivity/face_count.h"
#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"
#include "hooke/integrator/guards.h"
#include "hooke/mesh/halfedge_mesh.h"
#include "hooke/springs/energy.h"
#include "hooke/working_mesh/working_mesh.h"
#include "hooke/working_mesh/workspace.h"

namespace hooke {
namespace {

class SliverTrials {
 public:
  SliverTrials(WorkingMesh& mesh, const EnergyTerms& terms, const SliverTrialOptions& options,
               const GuardOptions& guards, const FaceCountLimits& limits)
      : m_(mesh),
        t_(mesh.halfedges),
        options_(options),
        trials_(mesh, terms, options.change, guards),
        limits_(limits),
        faces_(static_cast<double>(t_.faces().size())),
        max_tries_(std::max(options.min_in_all, static_cast<int>(options.share_in_all * faces_))) {}

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
    trials_.begin_with(sliver_angle);
    tried_at_.clear();
  }

  /// One round. False if there was nothing to try, or if it was interrupted.
  bool try_slivers(const Observer& observer) {
    const int most = std::min(
        std::clamp(static_cast<int>(options_.share * faces_), options_.min_tries, options_.max_tries),
        max_tries_ - changes_.tries);
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
      if (std::optional<EdgeCandidate> best = best_trial(edges)) keep(*best);
    }
    return tries < most;
  }

  double cotangent(int f) const {
    return max_cotangent(m_.positions.points, t_.faces()[static_cast<size_t>(f)]);
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

  std::vector<EdgeChange> changes_of(const std::vector<int>& edges) {
    const ChangeRules rules{.valence = options_.valence,
                            .splits = faces_ + 2 <= limits_.most,
                            .collapses = faces_ - 2 >= limits_.least};
    std::vector<EdgeChange> changes;
    for (int h : edges) {
      const std::vector<EdgeChange> allowed = allowed_changes(m_, h, rules);
      changes.insert(changes.end(), allowed.begin(), allowed.end());
      tried_at_[static_cast<size_t>(h)] = changes_.count();
    }
    return changes;
  }

  /// Of those that are as good at the end, the one that was best before the search.
  std::optional<EdgeCandidate> best_trial(const std::vector<int>& edges) {
    const std::vector<EdgeChange> changes = changes_of(edges);
    std::vector<EdgeCandidate> trials(changes.size());
    parallel_for(trials.size(), 1, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) trials[i] = trials_.begin(changes[i]);
    });
    const auto is_hopeless = [](const EdgeCandidate& trial) { return !trial.is_viable; };
    std::erase_if(trials, is_hopeless);
    std::ranges::stable_sort(trials, std::ranges::greater(), &EdgeCandidate::gain);
    if (trials.size() > options_.searched) trials.resize(options_.searched);
    parallel_for(trials.size(), 1, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) trials_.finish(trials[i]);
    });
    std::erase_if(trials, is_hopeless);
    const auto best = std::ranges::max_element(trials, {}, &EdgeCandidate::gain);
    return best == trials.end() ? std::nullopt : std::optional(std::move(*best));
  }

  /// The corners of the faces of its edge, what a merge joins anew, and those that have come so far, all in
  /// all, that it is noticed.
  std::vector<int> vertices_changed_by(const EdgeCandidate& trial) {
    const int h = trial.change.half_edge;
    std::vector<int> vertices = {t_.from(h), t_.to(h), t_.opposite_vertex(h), t_.opposite_vertex(t_.twin(h))};
    if (trial.change.kind == ChangeKind::collapse)
      for (int end : {t_.from(h), t_.to(h)})
        for (int v : t_.neighbours(end)) vertices.push_back(v);
    unnoticed_.resize(static_cast<size_t>(t_.id_count()), 0);
    for (Eigen::Index i = 0; i < trial.patch.positions.points.cols(); ++i) {
      const int v = trial.patch.vertices[static_cast<size_t>(i)];
      if (v < 0) continue;  // is to come
      double& moved = unnoticed_[static_cast<size_t>(v)];
      moved += (trial.patch.positions.points.col(i) - m_.positions.points.col(v)).norm();
      if (moved <= options_.noticed * m_.vertex_length[static_cast<size_t>(v)]) continue;
      moved = 0;
      vertices.push_back(v);
    }
    return vertices;
  }

  void keep(EdgeCandidate& trial) {
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
      case ChangeKind::collapse:
        ++changes_.collapses;
        faces_ -= 2;
        break;
    }
    changed_at_.resize(static_cast<size_t>(t_.id_count()), 0);
    for (int v : changed) changed_at_[static_cast<size_t>(v)] = changes_.count();
  }

  WorkingMesh& m_;
  HalfedgeMesh& t_;
  const SliverTrialOptions& options_;
  EdgeTrials trials_;
  FaceCountLimits limits_;
  double faces_;
  const int max_tries_;
  double sliver_cotangent_ = 0;
  std::vector<int> tried_at_;      // per half-edge that stands for its edge: changes so far; -1 for never
  std::vector<int> changed_at_;    // per id: changes so far, when the last one changed what is about it
  std::vector<double> unnoticed_;  // per id: the length of its moves since changed_at_ was set for them
  SliverChanges changes_;
  bool interrupted_ = false;
};

}  // namespace

SliverChanges change_slivers(WorkingMesh& m, const EnergyTerms& terms, const SliverTrialOptions& options,
                             const GuardOptions& guards, const FaceCountLimits& limits,
                             const Observer& observer) {
  return SliverTrials(m, terms, options, guards, limits).run(observer);
}

namespace {

/// In mode `flip` their number stays.
FaceCountLimits limits_of(const Workspace& work, ConnectivityMode mode, double share) {
  const auto& faces = work.adjacency->faces;
  const auto count = static_cast<double>(faces.size());
  if (mode == ConnectivityMode::flip) return {count, count};
  const double wanted = wanted_face_count(work.positions.points, faces, work.vertex_length);
  return {(1 - share) * wanted, (1 + share) * wanted};
}

}  // namespace

SliverChanges remove_slivers(Workspace& work, ConnectivityMode mode, const EnergyTerms& terms,
                             const SliverRemovalOptions& options, const GuardOptions& guards,
                             double corner_angle, const Observer& observer) {
  const std::vector<double>& angles = options.trials.sliver_angles;
  if (angles.empty() || min_angle(work.positions.points, work.adjacency->faces) >= angles.back()) return {};
  WorkspaceEdit adapting(work, corner_angle);
  const SliverChanges changes = change_slivers(adapting.mesh(), terms, options.trials, guards,
                                               limits_of(work, mode, options.count_share), observer);
  if (changes.count() == 0) return changes;
  if (mode == ConnectivityMode::flip) {
    adapting.replace_faces();
  } else {
    compact(adapting.mesh());
    adapting.replace_mesh();
  }
  return changes;
}

}  // namespace hooke
