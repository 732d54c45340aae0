#include "hooke/connectivity/valence_flips.h"

#include <algorithm>

#include "hooke/connectivity/edge_trial.h"
#include "hooke/core/parallel.h"
#include "hooke/filter/retraction.h"
#include "hooke/integrator/gauss_seidel.h"
#include "hooke/integrator/relaxation.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/halfedge_mesh.h"
#include "hooke/mesh/vertex_coloring.h"
#include "hooke/springs/target_lengths.h"
#include "hooke/working_mesh/patch.h"
#include "hooke/working_mesh/working_mesh.h"

namespace hooke {
namespace {

// The edges of a batch are tested in parallel against the mesh before the batch. They lie far apart: a batch
// takes every n-th candidate, for n batches, and candidates follow the order of the mesh.
constexpr size_t edges_of_batch = 512;
constexpr size_t min_batches = 16;

/// Valence excess of the corner from which h starts.
int irregularity(const WorkingMesh& m, int h) {
  const CornerValence corner = corner_valence(m, h);
  if (corner.target > 0) return corner.present - corner.target;
  return corner.present - (m.halfedges.on_boundary(m.halfedges.from(h)) ? 4 : 6);
}

/// Has the edge two or more irregular vertices among its four, whose irregularity the flip does not increase?
bool is_worth_testing(const WorkingMesh& m, int h) {
  const int g = m.halfedges.twin(h);
  int irregular = 0, before = 0, after = 0;
  const auto add = [&](int corner, int change) {
    const int i = irregularity(m, corner);
    irregular += i != 0;
    before += i * i;
    after += (i + change) * (i + change);
  };
  add(h, -1);
  add(g, -1);
  add(HalfedgeMesh::previous(h), 1);
  add(HalfedgeMesh::previous(g), 1);
  return irregular >= 2 && after <= before;
}

/// Adjacency of the two faces of an edge, before and after its flip.
struct Pair {
  Adjacency before = make_adjacency(4, {{0, 1, 2}, {1, 0, 3}});
  Adjacency after = make_adjacency(4, {{2, 0, 3}, {3, 1, 2}});
};

double energy_of(const EdgePatch& patch, const Adjacency& adjacency, const EnergyTerms& terms) {
  const TargetLengths targets = spread_target_lengths(adjacency, patch.vertices.vertex_length);
  return Energy(adjacency, targets, terms)(patch.vertices.positions.points, patch.vertices.positions.normals,
                                           nullptr);
}

class FlipPass {
 public:
  FlipPass(WorkingMesh& mesh, const EnergyTerms& terms, const FlipPassOptions& options,
           const ShapeLimits& limits, std::vector<char>& near)
      : m_(mesh),
        t_(mesh.halfedges),
        terms_(terms),
        options_(options),
        limits_(limits),
        unit_(std::max(terms.string, terms.altitude)),
        near_(near),
        batch_of_(mesh.vertices.vertex_length.size(), 0) {}

  int run(const Observer& observer) {
    for (int round = 0; round < options_.rounds; ++round) {
      const std::vector<int> edges = candidates();
      if (edges.empty()) break;
      near_.assign(batch_of_.size(), 0);
      const size_t batches = std::max(min_batches, (edges.size() + edges_of_batch - 1) / edges_of_batch);
      for (size_t i = 0; i < batches; ++i) {
        std::vector<int> batch;
        for (size_t k = i; k < edges.size(); k += batches) batch.push_back(edges[k]);
        keep_gains(batch, test_all(batch));
        if (observer && !observer({.step = batch_})) return flips_;
      }
      if (m_.after_move) m_.after_move();
    }
    return flips_;
  }

 private:
  bool is_candidate(int h) const {
    return t_.twin(h) >= 0 && !t_.is_crease(h) && is_worth_testing(m_, h) && may_flip(m_, h);
  }

  bool is_near(int h) const {
    const auto near = [this](int v) { return near_[v] != 0; };
    return near_.empty() || near(t_.from(h)) || near(t_.to(h)) || near(t_.opposite_vertex(h)) ||
           near(t_.opposite_vertex(t_.twin(h)));
  }

  std::vector<int> candidates() const {
    std::vector<char> found(t_.half_edge_count(), 0);
    parallel_for(found.size(), 4096, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) {
        const int h = static_cast<int>(i);
        found[i] = t_.twin(h) > h && is_near(h) && is_candidate(h);
      }
    });
    std::vector<int> edges;
    for (size_t h = 0; h < found.size(); ++h)
      if (found[h]) edges.push_back(static_cast<int>(h));
    return edges;
  }

  /// Flips the edge in its patch and relaxes that while the energy rise is within the limits. Returns the
  /// patch if its energy decreases enough.
  std::optional<EdgePatch> test_flip(int h) const {
    if (!is_candidate(h)) return std::nullopt;
    const double rise = energy_rise_of_flip(h);
    if (rise > options_.max_energy_rise * unit_) return std::nullopt;
    std::optional<EdgePatch> patch = cut_patch(m_, h, options_.rings, options_.max_vertices);
    if (!patch) return std::nullopt;
    const Adjacency c = make_adjacency(static_cast<int>(patch->wedge_ids.size()), flipped_faces(*patch));
    const TargetLengths targets = spread_target_lengths(c, patch->vertices.vertex_length);
    Retraction retraction(m_.retraction.surface(), patch->vertices.constraints, m_.retraction.options());
    const VertexColoring coloring = color_as_one_block(c);
    Relaxation r(c, coloring, targets, patch->vertices, retraction, terms_, limits_);
    LocalNewton newton(r);
    const double before = r.present_energy() - rise;
    for (int sweep = 0; sweep < options_.sweeps; ++sweep) {
      if (sweep > 0 && r.present_energy() - before > options_.max_rise_after_relaxation * unit_)
        return std::nullopt;
      for (size_t v = 0; v < patch->movable; ++v) newton.improve(static_cast<int>(v), {});
    }
    if (before - r.present_energy() < options_.gain) return std::nullopt;
    return patch;
  }

  double energy_rise_of_flip(int h) const {
    const EdgePatch patch = cut_pair(m_, h);
    return energy_of(patch, pair_.after, terms_) - energy_of(patch, pair_.before, terms_);
  }

  std::vector<std::optional<EdgePatch>> test_all(const std::vector<int>& edges) const {
    std::vector<std::optional<EdgePatch>> results(edges.size());
    parallel_for(edges.size(), 4, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) results[i] = test_flip(edges[i]);
    });
    return results;
  }

  /// Applies the successful flips. Those whose patch overlaps one applied earlier in the batch are marked to
  /// be tested again.
  void keep_gains(const std::vector<int>& edges, const std::vector<std::optional<EdgePatch>>& results) {
    ++batch_;
    for (size_t i = 0; i < edges.size(); ++i) {
      if (!results[i]) continue;
      const EdgePatch& patch = *results[i];
      if (meets_another(patch))
        mark_for_retest(patch, 2);  // at the two ends of the edge
      else if (!folds_at_patch_boundary(patch, flipped_faces(patch), m_, limits_))
        keep(edges[i], patch);
    }
  }

  bool meets_another(const EdgePatch& patch) const {
    return std::ranges::any_of(patch.vertex_ids, [this](int v) { return batch_of_[v] == batch_; });
  }

  void mark_for_retest(const EdgePatch& patch, size_t vertices) {
    for (size_t id = 0; id < vertices; ++id) near_[patch.vertex_ids[id]] = 1;
  }

  void keep(int edge, const EdgePatch& patch) {
    t_.flip(edge);
    move_vertices(patch, m_.vertices.positions);
    for (size_t id = 0; id < patch.movable; ++id) batch_of_[patch.vertex_ids[id]] = batch_;
    mark_for_retest(patch, patch.movable);
    ++flips_;
  }

  WorkingMesh& m_;
  HalfedgeMesh& t_;
  const EnergyTerms& terms_;
  const FlipPassOptions& options_;
  const ShapeLimits& limits_;
  const Pair pair_;
  double unit_;                // of the maximum energy rises
  std::vector<char>& near_;    // per vertex: flag that edges there are to be tested; all if empty
  std::vector<int> batch_of_;  // per vertex: the last batch in which it moved, from 1
  int batch_ = 0;
  int flips_ = 0;
};

}  // namespace

int flip_irregular_edges(WorkingMesh& m, const EnergyTerms& terms, const FlipPassOptions& options,
                         const ShapeLimits& limits, std::vector<char>& near, const Observer& observer) {
  return FlipPass(m, terms, options, limits, near).run(observer);
}

}  // namespace hooke
