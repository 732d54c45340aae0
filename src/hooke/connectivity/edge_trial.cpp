#include "hooke/connectivity/edge_trial.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hooke/connectivity/edge_flips.h"
#include "hooke/constraints/constraints.h"
#include "hooke/core/lists.h"
#include "hooke/filter/retraction.h"
#include "hooke/geometry/triangle.h"
#include "hooke/integrator/angle_search.h"
#include "hooke/integrator/gauss_seidel.h"
#include "hooke/integrator/relaxation.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/halfedge_mesh.h"
#include "hooke/mesh/vertex_coloring.h"
#include "hooke/working_mesh/working_mesh.h"

namespace hooke {
namespace {

void add_face(const SurfacePositions& p, const Triangle& t, double fair_angle, const ShapeLimits& limits,
              PatchQuality& quality) {
  const double cotangent = max_cotangent(p.points, t);
  const double lacks = std::max(0., fair_angle - angle_with_cotangent(cotangent));
  const double alignment = face_alignment(p.points, p.normals, t);
  const double misses = limits.alignment - alignment;
  quality.cotangent = std::max(quality.cotangent, cotangent);
  quality.area += .5 * doubled_area_vector(p.points, t).norm() * alignment;
  quality.angle_cost += lacks * lacks;
  quality.violation.alignment += std::max(0., misses);
  quality.violation.folds += misses > 0;
}

void add_edge(const SurfacePositions& p, const Edge& edge, double target, const ShapeLimits& limits,
              PatchQuality& quality) {
  const double length = (p.points.col(edge[1]) - p.points.col(edge[0])).norm() / target;
  const double sagitta = edge_sagitta(p.points, p.normals, edge) / target;
  quality.length_errors += (length - 1) * (length - 1);
  quality.violation.length = std::max(quality.violation.length, length - max_length_near_slivers);
  quality.violation.sagitta += std::max(0., sagitta - limits.sagitta);
}

void add_fold(const SurfacePositions& p, const Triangle& face, const Triangle& other,
              const ShapeLimits& limits, PatchQuality& quality) {
  const double misses = limits.fold - cosine_between(p.points, face, other);
  quality.violation.fold += std::max(0., misses);
  quality.violation.folds += misses > 0;
}

}  // namespace

bool is_no_worse(const PatchViolation& now, const PatchViolation& before) {
  return now.alignment <= before.alignment && now.fold <= before.fold && now.sagitta <= before.sagitta &&
         now.length <= before.length && now.folds <= before.folds;
}

PatchQuality measure_patch(const SurfacePositions& p, const Adjacency& c, const TargetLengths& targets,
                           double fair_angle, const ShapeLimits& limits) {
  PatchQuality quality;
  quality.edges = c.edges.size();
  for (const Triangle& t : c.faces) add_face(p, t, fair_angle, limits, quality);
  for (std::size_t e = 0; e < c.edges.size(); ++e) {
    add_edge(p, c.edges[e], targets.edge[e], limits, quality);
    if (const auto [f, g] = c.edge_faces[e]; g >= 0) add_fold(p, c.faces[f], c.faces[g], limits, quality);
  }
  return quality;
}

namespace {

class ChangeFinder {
 public:
  ChangeFinder(const WorkingMesh& mesh, const ChangeRules& rules)
      : m_(mesh), t_(mesh.halfedges), rules_(rules) {}

  std::vector<EdgeChange> changes(int h) const {
    std::vector<EdgeChange> changes;
    if (may_flip(h)) changes.push_back({h, ChangeKind::flip});
    if (rules_.splits && may_split(h)) changes.push_back({h, ChangeKind::split});
    if (rules_.collapses && may_collapse(h)) changes.push_back(collapse(h));
    return changes;
  }

 private:
  /// By how much a corner may miss its target valence where that makes better angles, as in a strip narrower
  /// than the target length, where only every other corner can have it.
  static constexpr int corner_slack = 1;

  bool may_gain_an_edge(int corner) const {
    const CornerValence valence = corner_valence(m_, corner);
    return valence.target > 0 ? valence.may_gain(corner_slack) : valence.present < rules_.valence;
  }

  bool may_lose_an_edge(int corner) const {
    const CornerValence valence = corner_valence(m_, corner);
    if (valence.target > 0) return valence.may_lose(corner_slack);
    return valence.present > (t_.on_boundary(t_.from(corner)) ? 2 : 3);
  }

  template <typename MayChange>
  bool at_both_opposite_vertices(int h, const MayChange& may_change) const {
    return may_change(HalfedgeMesh::previous(h)) && may_change(HalfedgeMesh::previous(t_.twin(h)));
  }

  /// A flip adds an edge to the opposite vertices, as a split does.
  bool may_flip(int h) const { return may_split(h) && flip_keeps_topology(m_, h, corner_slack); }

  bool may_split(int h) const {
    return !is_frozen_edge(m_, h) &&
           at_both_opposite_vertices(h, [this](int corner) { return may_gain_an_edge(corner); });
  }

  bool is_removable(int v) const {
    return m_.vertices.constraints.freedom[v] == Freedom::surface && !t_.on_boundary(v) && !t_.on_crease(v);
  }

  /// Would a remaining corner have no more edges than its target?
  bool may_absorb(int stays, int goes) const {
    const CornerValence corner = corner_valence(m_, stays);
    return corner.target == 0 || corner.present + t_.valence(t_.from(goes)) - 4 <= corner.target;
  }

  bool may_collapse(int h) const {
    const int g = t_.twin(h), a = t_.from(h), b = t_.to(h);
    if (!is_removable(a) && !is_removable(b)) return false;
    if (!is_removable(a) && !may_absorb(h, g)) return false;
    if (!is_removable(b) && !may_absorb(g, h)) return false;
    return t_.valence(a) + t_.valence(b) - 4 <= rules_.valence && t_.may_collapse(h) &&
           at_both_opposite_vertices(h, [this](int corner) { return may_lose_an_edge(corner); });
  }

  /// The more constrained end remains in its position; of two free ends the older one, moved to the midpoint.
  EdgeChange collapse(int h) const {
    const int a = t_.from(h), b = t_.to(h);
    const auto rank = [this](int v) {
      const int origin = m_.vertices.previous_ids[v];
      return std::tuple(is_removable(v), origin < 0, origin < 0 ? v : origin);
    };
    return {h, ChangeKind::collapse, rank(a) < rank(b) ? 0 : 1, is_removable(a) && is_removable(b)};
  }

  const WorkingMesh& m_;
  const HalfedgeMesh& t_;
  const ChangeRules& rules_;
};

/// Moves a vertex at one end of the edge to its midpoint.
void move_to_midpoint(EdgePatch& patch, int vertex, int to, const Surface& surface,
                      const RetractionOptions& options) {
  const Vec3 displacement =
      .5 * (patch.vertices.positions.points.col(to) - patch.vertices.positions.points.col(vertex));
  Retraction retraction(surface, patch.vertices.constraints, options);
  retraction.moved(patch.vertices.positions, vertex, displacement).write_to(patch.vertices.positions, vertex);
}

/// Appends the vertex at the midpoint of the edge. Returns its id.
int add_middle(EdgePatch& patch, const Surface& surface, const RetractionOptions& options) {
  const int v = append_vertex(patch, 0);
  move_to_midpoint(patch, v, 1, surface, options);
  return v;
}

void collapse_ends(EdgePatch& patch, const EdgeChange& collapse, const Surface& surface,
                   const RetractionOptions& options) {
  const int goes = 1 - collapse.stays;
  if (collapse.to_midpoint) move_to_midpoint(patch, collapse.stays, goes, surface, options);
  patch.vertices.constraints.freedom[goes] = Freedom::fixed;
}

}  // namespace

std::vector<int> inner_edges_about(const HalfedgeMesh& t, int face) {
  std::vector<int> edges;
  for (int corner : t.faces()[face])
    for (int entry : t.outgoing(corner))
      for (int h : {entry, HalfedgeMesh::next(entry), HalfedgeMesh::previous(entry)})
        if (!t.is_feature_edge(h)) edges.push_back(std::min(h, t.twin(h)));
  sort_unique(edges);
  return edges;
}

std::vector<EdgeChange> allowed_changes(const WorkingMesh& m, int half_edge, const ChangeRules& rules) {
  return ChangeFinder(m, rules).changes(half_edge);
}

std::vector<Triangle> change_patch(EdgePatch& patch, const EdgeChange& change, const Surface& surface,
                                   const RetractionOptions& options) {
  switch (change.kind) {
    case ChangeKind::flip:
      break;
    case ChangeKind::split:
      return split_faces(patch, add_middle(patch, surface, options));
    case ChangeKind::collapse:
      collapse_ends(patch, change, surface, options);
      return collapsed_faces(patch, change.stays);
  }
  return flipped_faces(patch);
}

void change_mesh(WorkingMesh& m, const EdgeChange& change, EdgePatch& patch) {
  HalfedgeMesh& t = m.halfedges;
  const int h = change.half_edge;
  switch (change.kind) {
    case ChangeKind::flip:
      t.flip(h);
      break;
    case ChangeKind::split:
      patch.vertex_ids.back() = add_vertex(m, h);
      t.split(h);
      break;
    case ChangeKind::collapse:
      t.collapse(h, change.stays == 0 ? t.from(h) : t.to(h));
      break;
  }
  move_vertices(patch, m.vertices.positions);
}

namespace {

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.) / static_cast<double>(values.size());
}

}  // namespace

CandidateEvaluator::CandidateEvaluator(const WorkingMesh& mesh, const EnergyTerms& terms,
                                       const ShapeLimits& limits)
    : m_(mesh), terms_(terms), limits_(limits) {
  limits_.sagitta = max_sagitta_near_slivers;
}

void CandidateEvaluator::set_sliver_angle(double sliver_angle) {
  constexpr double margin = 6;  // degrees
  fair_angle_ = sliver_angle + margin;
}

PatchQuality CandidateEvaluator::quality_before(const EdgePatch& patch) const {
  const Adjacency c = make_adjacency(static_cast<int>(patch.wedge_ids.size()), patch.faces);
  return measure_patch(patch.vertices.positions, c, spread_target_lengths(c, patch.vertices.vertex_length),
                       fair_angle_, limits_);
}

/// Length errors are scaled to the same number of edges, so that splits and collapses compare fairly.
double CandidateEvaluator::gain(const PatchQuality& before, const PatchQuality& now) const {
  constexpr double length_weight = 100;  // degrees squared
  const double errors_before = before.length_errors,
               errors_now =
                   now.length_errors * static_cast<double>(before.edges) / static_cast<double>(now.edges);
  return before.angle_cost - now.angle_cost + length_weight * (errors_before - errors_now);
}

EdgeCandidate CandidateEvaluator::cut(const EdgeChange& change) const {
  constexpr int rings = 2;             // around the edge, within which vertices are relaxed
  constexpr size_t max_vertices = 48;  // edges with more of these are not tested
  EdgeCandidate candidate;
  candidate.change = change;
  std::optional<EdgePatch> patch = cut_patch(m_, change.half_edge, rings, max_vertices);
  if (!patch) return candidate;
  candidate.patch = std::move(*patch);
  candidate.before = quality_before(candidate.patch);
  const std::vector<Triangle> faces = change_patch(candidate.patch, change, m_.retraction.surface(),
                                                   m_.retraction.options());  // may append a vertex
  candidate.adjacency = make_adjacency(static_cast<int>(candidate.patch.wedge_ids.size()), faces);
  candidate.targets = spread_target_lengths(candidate.adjacency, candidate.patch.vertices.vertex_length);
  candidate.is_viable = true;
  return candidate;
}

/// Calls body(relaxation) and measures the patch afterwards.
template <typename Relax>
PatchQuality CandidateEvaluator::relax(EdgeCandidate& candidate, const Relax& body) const {
  Retraction retraction(m_.retraction.surface(), candidate.patch.vertices.constraints,
                        m_.retraction.options());
  const VertexColoring coloring = color_as_one_block(candidate.adjacency);
  Relaxation r(candidate.adjacency, coloring, candidate.targets, candidate.patch.vertices, retraction, terms_,
               limits_);
  body(r);
  return measure_patch(candidate.patch.vertices.positions, candidate.adjacency, candidate.targets,
                       fair_angle_, limits_);
}

EdgeCandidate CandidateEvaluator::begin(const EdgeChange& change) const {
  constexpr int sweeps = 3;              // of Newton's method vertex by vertex
  constexpr double max_cost_rise = 500;  // degrees squared; to go on after the sweeps
  EdgeCandidate candidate = cut(change);
  if (!candidate.is_viable) return candidate;
  const PatchQuality now = relax(candidate, [](Relaxation& r) {
    for (int sweep = 0; sweep < sweeps; ++sweep) local_newton_sweep(r, {}, {});
  });
  candidate.gain = gain(candidate.before, now);
  candidate.is_viable = candidate.gain >= -max_cost_rise;
  return candidate;
}

void CandidateEvaluator::finish(EdgeCandidate& candidate) const {
  constexpr AngleSearchOptions search = {
      .spring_range = 0, .edge_error_limit = 1.2, .sagitta = 0, .max_rounds = 12, .max_set_aside = 0};
  constexpr double least_gain = 4;  // degrees squared
  // Over the squared mean target length; keeps the margins of thin sheets.
  constexpr double max_area_loss = .2;
  const PatchQuality& before = candidate.before;
  const PatchQuality after = relax(candidate, [&](Relaxation& r) { search_angles(r, search); });
  candidate.gain = gain(before, after);
  candidate.is_viable = candidate.gain >= least_gain && after.cotangent <= before.cotangent &&
                        before.area - after.area <=
                            max_area_loss * std::pow(mean_of(candidate.patch.vertices.vertex_length), 2) &&
                        is_no_worse(after.violation, before.violation) &&
                        !folds_at_patch_boundary(candidate.patch, candidate.adjacency.faces, m_, limits_);
}

bool folds_at_patch_boundary(const EdgePatch& patch, const std::vector<Triangle>& faces, const WorkingMesh& m,
                             const ShapeLimits& limits) {
  const HalfedgeMesh& t = m.halfedges;
  const Mat3X& X = m.vertices.positions.points;
  return std::ranges::any_of(patch.boundary, [&](const PatchBoundary& edge) {
    const Triangle& face = t.faces()[edge.half_edge / 3];
    const Triangle& neighbour = t.faces()[t.twin(edge.half_edge) / 3];
    const double before = cosine_between(X, face, neighbour);
    const Triangle& changed = face_along(faces, edge.from, edge.to);
    const Vec3 across = edge.twin_ends[0] < 0
                            ? doubled_area_vector(X, neighbour)
                            : doubled_area_vector(patch.vertices.positions.points,
                                                  face_along(faces, edge.twin_ends[0], edge.twin_ends[1]));
    const double after =
        cosine_between(doubled_area_vector(patch.vertices.positions.points, changed), across);
    return t.is_crease(edge.half_edge) ? crease_fold_breaks(limits, before, after)
                                       : fold_breaks(limits, before, after);
  });
}

}  // namespace hooke
