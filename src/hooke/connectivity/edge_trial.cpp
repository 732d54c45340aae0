#include "hooke/connectivity/edge_trial.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "hooke/connectivity/edge_flips.h"
#include "hooke/constraints/constraints.h"
#include "hooke/filter/retraction.h"
#include "hooke/geometry/triangle.h"
#include "hooke/integrator/gauss_seidel.h"
#include "hooke/integrator/guards.h"
#include "hooke/integrator/relaxation.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/halfedge_mesh.h"
#include "hooke/mesh/vertex_coloring.h"
#include "hooke/working_mesh/working_mesh.h"

namespace hooke {
namespace {

void add_face(const SurfacePositions& p, const Triangle& t, const PatchLimits& limits, PatchQuality& look) {
  const double cotangent = max_cotangent(p.points, t);
  const double lacks = std::max(0., limits.fair_angle - angle_with_cotangent(cotangent));
  const double alignment = face_alignment(p.points, p.normals, t);
  const double misses = limits.alignment - alignment;
  look.cotangent = std::max(look.cotangent, cotangent);
  look.area += .5 * doubled_area_vector(p.points, t).norm() * alignment;
  look.angle_cost += lacks * lacks;
  look.excess.alignment += std::max(0., misses);
  look.excess.folds += misses > 0;
}

void add_edge(const SurfacePositions& p, const Edge& edge, double target, const PatchLimits& limits,
              PatchQuality& look) {
  const double length = (p.points.col(edge[1]) - p.points.col(edge[0])).norm() / target;
  const double sagitta = edge_sagitta(p.points, p.normals, edge) / target;
  look.length_errors += (length - 1) * (length - 1);
  look.excess.length = std::max(look.excess.length, length - limits.longest);
  look.excess.sagitta += std::max(0., sagitta - limits.sagitta);
}

void add_fold(const SurfacePositions& p, const Triangle& face, const Triangle& other,
              const PatchLimits& limits, PatchQuality& look) {
  const double misses = limits.fold - cosine_between(p.points, face, other);
  look.excess.fold += std::max(0., misses);
  look.excess.folds += misses > 0;
}

}  // namespace

bool is_no_worse(const PatchViolation& now, const PatchViolation& before) {
  return now.alignment <= before.alignment && now.fold <= before.fold && now.sagitta <= before.sagitta &&
         now.length <= before.length && now.folds <= before.folds;
}

PatchQuality look_at(const SurfacePositions& p, const Adjacency& c, const TargetLengths& targets,
                     const PatchLimits& limits) {
  PatchQuality look;
  look.edges = c.edges.size();
  for (const Triangle& t : c.faces) add_face(p, t, limits, look);
  for (std::size_t e = 0; e < c.edges.size(); ++e) {
    add_edge(p, c.edges[e], targets.edge[e], limits, look);
    if (const auto [f, g] = c.edge_faces[e]; g >= 0)
      add_fold(p, c.faces[static_cast<std::size_t>(f)], c.faces[static_cast<std::size_t>(g)], limits, look);
  }
  return look;
}

namespace {

class Choice {
 public:
  Choice(const WorkingMesh& mesh, const ChangeRules& rules)
      : m_(mesh), flipping_(mesh.flipping()), t_(mesh.halfedges), rules_(rules) {}

  std::vector<EdgeChange> changes(int h) const {
    std::vector<EdgeChange> changes;
    if (may_flip(h)) changes.push_back({h, ChangeKind::flip});
    if (rules_.splits && may_split(h)) changes.push_back({h, ChangeKind::split});
    if (rules_.collapses && may_collapse(h)) changes.push_back(collapse(h));
    return changes;
  }

 private:
  bool may_gain_an_edge(int corner) const {
    const CornerValence valence = corner_valence(flipping_, corner);
    return valence.wanted > 0 ? valence.has < valence.wanted : valence.has < rules_.valence;
  }

  bool may_lose_an_edge(int corner) const {
    const CornerValence valence = corner_valence(flipping_, corner);
    if (valence.wanted > 0) return valence.has > valence.wanted;
    return valence.has > (t_.on_boundary(t_.from(corner)) ? 2 : 3);
  }

  template <typename MayChange>
  bool at_both_apexes(int h, const MayChange& may_change) const {
    return may_change(HalfedgeMesh::previous(h)) && may_change(HalfedgeMesh::previous(t_.twin(h)));
  }

  /// A flip brings the corners across one more edge, too.
  bool may_flip(int h) const {
    constexpr double any = std::numeric_limits<double>::infinity();
    return may_split(h) &&
           hooke::may_flip(flipping_, h, {.area_share = 0, .alignment = -1, .fold = -any, .sagitta = any});
  }

  bool may_split(int h) const {
    return at_both_apexes(h, [this](int corner) { return may_gain_an_edge(corner); });
  }

  bool may_go(int v) const {
    return m_.constraints.freedom[static_cast<size_t>(v)] == Freedom::surface && !t_.on_boundary(v) &&
           !t_.on_crease(v);
  }

  /// Does a corner that stays keep to the edges it wants?
  bool may_take_up(int stays, int goes) const {
    const CornerValence corner = corner_valence(flipping_, stays);
    return corner.wanted == 0 || corner.has + t_.valence(t_.from(goes)) - 4 <= corner.wanted;
  }

  bool may_collapse(int h) const {
    const int g = t_.twin(h), a = t_.from(h), b = t_.to(h);
    if (!may_go(a) && !may_go(b)) return false;
    if (!may_go(a) && !may_take_up(h, g)) return false;
    if (!may_go(b) && !may_take_up(g, h)) return false;
    return t_.valence(a) + t_.valence(b) - 4 <= rules_.valence && t_.may_collapse(h) &&
           at_both_apexes(h, [this](int corner) { return may_lose_an_edge(corner); });
  }

  /// Of two alike that one stays which has been there longer, and goes to the middle.
  EdgeChange collapse(int h) const {
    const int a = t_.from(h), b = t_.to(h);
    const auto rank = [this](int v) {
      const int origin = m_.origins[static_cast<size_t>(v)];
      return std::tuple(may_go(v), origin < 0, origin < 0 ? v : origin);
    };
    return {h, ChangeKind::collapse, rank(a) < rank(b) ? 0 : 1, may_go(a) && may_go(b)};
  }

  const WorkingMesh& m_;
  const FlippableMesh flipping_;
  const HalfedgeMesh& t_;
  const ChangeRules& rules_;
};

/// A vertex that is at one end of the edge goes half the way to the other.
void move_half_way(EdgePatch& patch, int vertex, int to, const Surface& surface,
                   const RetractionOptions& options) {
  const Vec3 way = .5 * (patch.positions.points.col(to) - patch.positions.points.col(vertex));
  Retraction retraction(surface, patch.constraints, options);
  retraction.moved(patch.positions, vertex, way).write_to(patch.positions, vertex);
}

/// Appends the vertex in the middle of the edge. Returns its id.
int add_middle(EdgePatch& patch, const Surface& surface, const RetractionOptions& options) {
  const int v = append_vertex(patch, 0);
  move_half_way(patch, v, 1, surface, options);
  return v;
}

void collapse_ends(EdgePatch& patch, const EdgeChange& collapse, const Surface& surface,
                   const RetractionOptions& options) {
  const int goes = 1 - collapse.stays;
  if (collapse.half_way) move_half_way(patch, collapse.stays, goes, surface, options);
  patch.constraints.freedom[static_cast<size_t>(goes)] = Freedom::fixed;
}

}  // namespace

std::vector<int> inner_edges_about(const HalfedgeMesh& t, int face) {
  std::vector<int> edges;
  for (int corner : t.faces()[static_cast<size_t>(face)])
    for (int entry : t.outgoing(corner))
      for (int h : {entry, HalfedgeMesh::next(entry), HalfedgeMesh::previous(entry)})
        if (!t.is_feature_edge(h)) edges.push_back(std::min(h, t.twin(h)));
  std::ranges::sort(edges);
  const auto rest = std::ranges::unique(edges);
  edges.erase(rest.begin(), rest.end());
  return edges;
}

std::vector<EdgeChange> allowed_changes(const WorkingMesh& m, int half_edge, const ChangeRules& rules) {
  return Choice(m, rules).changes(half_edge);
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
      patch.vertices.back() = add_vertex(m, h);
      t.split(h);
      break;
    case ChangeKind::collapse:
      t.collapse(h, change.stays == 0 ? t.from(h) : t.to(h));
      break;
  }
  move_vertices(patch, m.positions);
}

namespace {

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.) / static_cast<double>(values.size());
}

}  // namespace

EdgeTrials::EdgeTrials(const WorkingMesh& mesh, const EnergyTerms& terms, const EdgeTrialOptions& options,
                       const GuardOptions& guards)
    : m_(mesh), terms_(terms), options_(options), guards_(guards) {
  guards_.sagitta = options.sagitta;
}

void EdgeTrials::begin_with(double sliver_angle) {
  limits_ = {sliver_angle + options_.fair_margin, guards_.alignment, guards_.fold, options_.sagitta,
             options_.longest};
}

PatchQuality EdgeTrials::look_before(const EdgePatch& patch) const {
  const Adjacency c = make_adjacency(static_cast<int>(patch.wedges.size()), patch.faces);
  return look_at(patch.positions, c, spread_target_lengths(c, patch.vertex_length), limits_);
}

/// A vertex that comes or goes takes no credit for the number of its edges.
double EdgeTrials::gain(const PatchQuality& before, const PatchQuality& now) const {
  const double errors_before = before.length_errors,
               errors_now =
                   now.length_errors * static_cast<double>(before.edges) / static_cast<double>(now.edges);
  return before.angle_cost - now.angle_cost + options_.length_weight * (errors_before - errors_now);
}

EdgeCandidate EdgeTrials::cut(const EdgeChange& change) const {
  EdgeCandidate trial;
  trial.change = change;
  std::optional<EdgePatch> patch = cut_patch(m_.flipping(), change.half_edge, options_.rings, options_.most);
  if (!patch) return trial;
  trial.patch = std::move(*patch);
  trial.before = look_before(trial.patch);
  trial.adjacency =
      make_adjacency(static_cast<int>(trial.patch.wedges.size()),
                     change_patch(trial.patch, change, m_.retraction.surface(), m_.retraction.options()));
  trial.targets = spread_target_lengths(trial.adjacency, trial.patch.vertex_length);
  trial.is_viable = true;
  return trial;
}

/// Calls body(relaxation) and looks at the patch again.
template <typename Relax>
PatchQuality EdgeTrials::relax(EdgeCandidate& trial, const Relax& body) const {
  Energy energy(trial.adjacency, trial.targets, terms_);
  Guards guards(trial.adjacency, trial.targets, guards_);
  Retraction retraction(m_.retraction.surface(), trial.patch.constraints, m_.retraction.options());
  const VertexColoring coloring = color_as_one_block(trial.adjacency);
  Relaxation r{trial.adjacency, coloring, trial.patch.vertex_length, energy,
               retraction,      guards,   trial.patch.positions};
  body(r);
  return look_at(trial.patch.positions, trial.adjacency, trial.targets, limits_);
}

EdgeCandidate EdgeTrials::begin(const EdgeChange& change) const {
  EdgeCandidate trial = cut(change);
  if (!trial.is_viable) return trial;
  const PatchQuality now = relax(trial, [this](Relaxation& r) {
    for (int sweep = 0; sweep < options_.sweeps; ++sweep) local_newton_sweep(r, {}, {});
  });
  trial.gain = gain(trial.before, now);
  trial.is_viable = trial.gain >= -options_.max_energy_rise;
  return trial;
}

void EdgeTrials::finish(EdgeCandidate& trial) const {
  const PatchQuality& before = trial.before;
  const PatchQuality after = relax(trial, [this](Relaxation& r) { search_angles(r, options_.search); });
  trial.gain = gain(before, after);
  trial.is_viable =
      trial.gain >= options_.gain && after.cotangent <= before.cotangent &&
      before.area - after.area <= options_.area_loss * std::pow(mean_of(trial.patch.vertex_length), 2) &&
      is_no_worse(after.excess, before.excess) &&
      !folds_at_rim(trial.patch, trial.adjacency.faces, m_.flipping(), guards_);
}

bool folds_at_rim(const EdgePatch& patch, const std::vector<Triangle>& faces, const FlippableMesh& m,
                  const GuardOptions& guards) {
  const HalfedgeMesh& t = m.halfedges;
  const Mat3X& X = m.positions.points;
  return std::ranges::any_of(patch.rim, [&](const PatchBoundary& rim) {
    const Triangle& face = t.faces()[static_cast<size_t>(rim.half_edge / 3)];
    const Triangle& beyond = t.faces()[static_cast<size_t>(t.twin(rim.half_edge) / 3)];
    const double before = cosine_between(X, face, beyond);
    const Triangle& changed = face_along(faces, rim.from, rim.to);
    const Vec3 across =
        rim.beyond[0] < 0
            ? doubled_area_vector(X, beyond)
            : doubled_area_vector(patch.positions.points, face_along(faces, rim.beyond[0], rim.beyond[1]));
    const double after = cosine_between(doubled_area_vector(patch.positions.points, changed), across);
    return t.is_crease(rim.half_edge) ? crease_fold_breaks(guards, before, after)
                                      : fold_breaks(guards, before, after);
  });
}

}  // namespace hooke
