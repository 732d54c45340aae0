#include "hooke/connectivity/sliver_removal.h"

#include <algorithm>
#include <optional>

#include "hooke/connectivity/face_count.h"
#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/halfedge_mesh.h"
#include "hooke/springs/energy.h"
#include "hooke/working_mesh/working_mesh.h"
#include "hooke/working_mesh/workspace.h"

namespace hooke {
namespace {

class SliverPass {
 public:
  SliverPass(WorkingMesh& mesh, const EnergyTerms& terms, const SliverOptions& options,
             const ShapeLimits& limits, const FaceCountLimits& allowed_faces, int tested_before)
      : m_(mesh),
        t_(mesh.halfedges),
        options_(options),
        evaluator_(mesh, terms, limits),
        allowed_faces_(allowed_faces),
        faces_(static_cast<double>(t_.faces().size())),
        max_tested_(std::max(
            0,
            std::max(options.min_in_all, static_cast<int>(options.share_in_all * faces_)) - tested_before)) {}

  SliverChanges run(const Observer& observer) {
    for (double angle : options_.sliver_angles) {
      begin_stage(angle);
      for (int round = 0; round < options_.rounds && test_slivers(observer); ++round) continue;
      if (interrupted_) break;
    }
    m_.retraction.count();
    return changes_;
  }

 private:
  void begin_stage(double sliver_angle) {
    sliver_cotangent_ = cotangent_of(sliver_angle);
    evaluator_.set_sliver_angle(sliver_angle);
    tested_at_.clear();
  }

  /// One round. False if there was nothing to test, or if it was interrupted.
  bool test_slivers(const Observer& observer) {
    constexpr double share = .01;          // slivers tested per round, worst first, as a share of the faces
    constexpr int least = 10, most = 200;  // of that number
    const int limit =
        std::min(std::clamp(static_cast<int>(share * faces_), least, most), max_tested_ - changes_.tested);
    int left = limit;
    for (int f : slivers()) {
      if (left == 0) break;
      if (!is_sliver(f)) continue;
      const std::vector<int> edges = untested_edges_about(f);
      if (edges.empty()) continue;
      interrupted_ = observer && !observer({.step = changes_.count()});
      if (interrupted_) return false;
      --left;
      ++changes_.tested;
      if (std::optional<EdgeCandidate> best = best_candidate(edges)) keep(*best);
    }
    return left < limit;
  }

  double cotangent(int f) const { return max_cotangent(m_.vertices.positions.points, t_.faces()[f]); }

  /// A frozen face cannot be mended.
  bool is_sliver(int f) const {
    return !t_.is_removed(f) && cotangent(f) > sliver_cotangent_ &&
           !m_.vertices.constraints.is_frozen(t_.faces()[f]);
  }

  /// Worst first.
  std::vector<int> slivers() const {
    std::vector<int> faces;
    for (int f = 0; f < t_.half_edge_count() / 3; ++f)
      if (is_sliver(f)) faces.push_back(f);
    std::ranges::stable_sort(faces, std::ranges::greater(), [this](int f) { return cotangent(f); });
    return faces;
  }

  /// Edges whose neighbourhood has changed noticeably since they were tested last.
  std::vector<int> untested_edges_about(int face) {
    tested_at_.resize(t_.half_edge_count(), -1);
    changed_at_.resize(t_.id_count(), 0);
    std::vector<int> edges = inner_edges_about(t_, face);
    std::erase_if(edges, [this](int h) {
      const int changed = std::max(changed_at_[t_.from(h)], changed_at_[t_.to(h)]);
      return tested_at_[h] >= changed;
    });
    return edges;
  }

  std::vector<EdgeChange> changes_of(const std::vector<int>& edges) {
    const ChangeRules rules{.splits = faces_ + 2 <= allowed_faces_.max,
                            .collapses = faces_ - 2 >= allowed_faces_.min};
    std::vector<EdgeChange> changes;
    for (int h : edges) {
      const std::vector<EdgeChange> allowed = allowed_changes(m_, h, rules);
      changes.insert(changes.end(), allowed.begin(), allowed.end());
      tested_at_[h] = changes_.count();
    }
    return changes;
  }

  /// The candidate with the largest gain; among equals the one with the largest gain before the search.
  std::optional<EdgeCandidate> best_candidate(const std::vector<int>& edges) {
    const std::vector<EdgeChange> changes = changes_of(edges);
    std::vector<EdgeCandidate> candidates(changes.size());
    parallel_for(candidates.size(), 1, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) candidates[i] = evaluator_.begin(changes[i]);
    });
    const auto is_rejected = [](const EdgeCandidate& candidate) { return !candidate.is_viable; };
    std::erase_if(candidates, is_rejected);
    std::ranges::stable_sort(candidates, std::ranges::greater(), &EdgeCandidate::gain);
    if (candidates.size() > options_.searched) candidates.resize(options_.searched);
    parallel_for(candidates.size(), 1, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) evaluator_.finish(candidates[i]);
    });
    std::erase_if(candidates, is_rejected);
    const auto best = std::ranges::max_element(candidates, {}, &EdgeCandidate::gain);
    return best == candidates.end() ? std::nullopt : std::optional(std::move(*best));
  }

  /// The vertices of the two faces of its edge, the one-ring of a collapse, and vertices whose accumulated
  /// moves are noticeable.
  std::vector<int> vertices_changed_by(const EdgeCandidate& candidate) {
    constexpr double noticeable = .03;  // in target lengths
    const int h = candidate.change.half_edge;
    std::vector<int> vertices = {t_.from(h), t_.to(h), t_.opposite_vertex(h), t_.opposite_vertex(t_.twin(h))};
    if (candidate.change.kind == ChangeKind::collapse)
      for (int end : {t_.from(h), t_.to(h)})
        for (int v : t_.neighbours(end)) vertices.push_back(v);
    unnoticed_.resize(t_.id_count(), 0);
    for (Eigen::Index i = 0; i < candidate.patch.vertices.positions.points.cols(); ++i) {
      const int v = candidate.patch.vertex_ids[i];
      if (v < 0) continue;  // the new vertex of a split
      double& moved = unnoticed_[v];
      moved +=
          (candidate.patch.vertices.positions.points.col(i) - m_.vertices.positions.points.col(v)).norm();
      if (moved <= noticeable * m_.vertices.vertex_length[v]) continue;
      moved = 0;
      vertices.push_back(v);
    }
    return vertices;
  }

  void keep(EdgeCandidate& candidate) {
    std::vector<int> changed = vertices_changed_by(candidate);
    change_mesh(m_, candidate.change, candidate.patch);
    switch (candidate.change.kind) {
      case ChangeKind::flip:
        ++changes_.flips;
        break;
      case ChangeKind::split:
        ++changes_.splits;
        changed.push_back(candidate.patch.vertex_ids.back());
        faces_ += 2;
        break;
      case ChangeKind::collapse:
        ++changes_.collapses;
        faces_ -= 2;
        break;
    }
    changed_at_.resize(t_.id_count(), 0);
    for (int v : changed) changed_at_[v] = changes_.count();
  }

  WorkingMesh& m_;
  HalfedgeMesh& t_;
  const SliverOptions& options_;
  CandidateEvaluator evaluator_;
  FaceCountLimits allowed_faces_;
  double faces_;
  const int max_tested_;
  double sliver_cotangent_ = 0;
  std::vector<int> tested_at_;     // per half-edge: number of changes when its edge was tested last, or -1
  std::vector<int> changed_at_;    // per id: number of changes when its neighbourhood last changed noticeably
  std::vector<double> unnoticed_;  // per id: accumulated length of its moves too small to be noticed
  SliverChanges changes_;
  bool interrupted_ = false;
};

}  // namespace

SliverChanges change_slivers(WorkingMesh& m, const EnergyTerms& terms, const SliverOptions& options,
                             const ShapeLimits& limits, const FaceCountLimits& allowed_faces,
                             int tested_before, const Observer& observer) {
  return SliverPass(m, terms, options, limits, allowed_faces, tested_before).run(observer);
}

namespace {

/// In mode `flip` the number of faces is fixed.
FaceCountLimits limits_of(const Workspace& work, ConnectivityMode mode) {
  constexpr double share = .02, least = 2;  // by which mode `adapt` may miss the target face count
  const auto& faces = work.adjacency->faces;
  const auto count = static_cast<double>(faces.size());
  if (mode == ConnectivityMode::flip) return {count, count};
  const double target = target_face_count(work.vertices, faces);
  const double slack = std::max(share * target, least);
  return {target - slack, target + slack};
}

}  // namespace

SliverChanges remove_slivers(Workspace& work, ConnectivityMode mode, const EnergyTerms& terms,
                             const SliverOptions& options, const ShapeLimits& limits, int tested_before,
                             const Observer& observer) {
  const std::vector<double>& angles = options.sliver_angles;
  if (angles.empty() || min_angle(work.vertices.positions.points, work.adjacency->faces) >= angles.back())
    return {};
  work.set_corner_valences();
  WorkingMesh mesh(work);
  const SliverChanges changes =
      change_slivers(mesh, terms, options, limits, limits_of(work, mode), tested_before, observer);
  if (changes.count() == 0) return changes;
  if (mode == ConnectivityMode::flip) {
    work.replace_faces(mesh.halfedges.faces());
  } else {
    compact(mesh);
    work.replace_mesh(mesh.halfedges.faces(), mesh.halfedges.wedges());
  }
  return changes;
}

}  // namespace hooke
