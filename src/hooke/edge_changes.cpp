#include "hooke/edge_changes.h"

#include <algorithm>
#include <limits>

namespace hooke {
namespace {

class Choice {
 public:
  Choice(const AdaptingMesh& mesh, const ChangeRules& rules)
      : m_(mesh), flipping_(mesh.flipping()), t_(mesh.triangulation), rules_(rules) {}

  void add_changes(int h, std::vector<EdgeChange>& changes) const {
    if (may_flip(h)) changes.push_back({h, ChangeKind::flip});
    if (rules_.splits && may_split(h)) changes.push_back({h, ChangeKind::split});
    if (!rules_.merges) return;
    if (const int stays = staying_end(h); stays >= 0) changes.push_back({h, ChangeKind::merge, stays});
  }

  /// One half-edge of each inner edge, ascending.
  std::vector<int> edges_about(int face) const {
    std::vector<int> edges;
    for (int corner : t_.faces()[static_cast<size_t>(face)])
      for (int spoke : t_.outgoing(corner))
        for (int h : {spoke, Triangulation::next(spoke), Triangulation::previous(spoke)})
          if (!t_.is_border(h)) edges.push_back(std::min(h, t_.twin(h)));
    std::ranges::sort(edges);
    const auto rest = std::ranges::unique(edges);
    edges.erase(rest.begin(), rest.end());
    return edges;
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
    return may_change(Triangulation::previous(h)) && may_change(Triangulation::previous(t_.twin(h)));
  }

  bool may_flip(int h) const {
    constexpr double any = std::numeric_limits<double>::infinity();
    return at_both_apexes(h, [this](int corner) { return may_gain_an_edge(corner); }) &&
           hooke::may_flip(flipping_, h, {.area_share = 0, .alignment = -1, .fold = -any, .sagitta = any});
  }

  bool may_split(int h) const {
    return at_both_apexes(h, [this](int corner) { return may_gain_an_edge(corner); });
  }

  bool may_go(int v) const {
    return m_.constraints.freedom[static_cast<size_t>(v)] == Freedom::surface && !t_.on_boundary(v) &&
           !t_.on_crease(v);
  }

  /// Of two alike that which has been there longer; -1 where the ends may not become one.
  int staying_end(int h) const {
    const int a = t_.from(h), b = t_.to(h);
    if (!may_go(a) && !may_go(b)) return -1;
    if (t_.valence(a) + t_.valence(b) - 4 > rules_.valence || !t_.may_collapse(h)) return -1;
    if (!at_both_apexes(h, [this](int corner) { return may_lose_an_edge(corner); })) return -1;
    const auto rank = [this](int v) {
      const int origin = m_.origins[static_cast<size_t>(v)];
      return std::tuple(may_go(v), origin < 0, origin < 0 ? v : origin);
    };
    return rank(a) < rank(b) ? 0 : 1;
  }

  const AdaptingMesh& m_;
  const FlippingMesh flipping_;
  const Triangulation& t_;
  const ChangeRules& rules_;
};

bool is_free(const EdgePatch& patch, int v) {
  return patch.constraints.freedom[static_cast<size_t>(v)] != Freedom::fixed;
}

/// Appends the vertex in the middle of the edge. Returns its id.
int add_middle(EdgePatch& patch, const Surface& surface, const RetractionOptions& options) {
  const Vec3 way = .5 * (patch.placement.points.col(1) - patch.placement.points.col(0));
  const int v = append_vertex(patch, 0);
  Retraction retraction(surface, patch.constraints, options);
  retraction.moved(patch.placement, v, way).write_to(patch.placement, v);
  return v;
}

/// Two ends that are as free meet in the middle.
void merge_ends(EdgePatch& patch, int stays, const Surface& surface, const RetractionOptions& options) {
  const int goes = 1 - stays;
  if (is_free(patch, stays)) {
    const Vec3 way = .5 * (patch.placement.points.col(goes) - patch.placement.points.col(stays));
    Retraction retraction(surface, patch.constraints, options);
    retraction.moved(patch.placement, stays, way).write_to(patch.placement, stays);
  }
  patch.constraints.freedom[static_cast<size_t>(goes)] = Freedom::fixed;
}

}  // namespace

std::vector<EdgeChange> changes_about(const AdaptingMesh& m, int face, const ChangeRules& rules) {
  const Choice choice(m, rules);
  std::vector<EdgeChange> changes;
  for (int h : choice.edges_about(face)) choice.add_changes(h, changes);
  return changes;
}

std::vector<Triangle> change_patch(EdgePatch& patch, const EdgeChange& change, const Surface& surface,
                                   const RetractionOptions& options) {
  switch (change.kind) {
    case ChangeKind::flip:
      break;
    case ChangeKind::split:
      return halved_faces(patch, add_middle(patch, surface, options));
    case ChangeKind::merge:
      merge_ends(patch, change.stays, surface, options);
      return merged_faces(patch, change.stays);
  }
  return flipped_faces(patch);
}

void change_mesh(AdaptingMesh& m, const EdgeChange& change, EdgePatch& patch) {
  Triangulation& t = m.triangulation;
  const int h = change.half_edge;
  switch (change.kind) {
    case ChangeKind::flip:
      t.flip(h);
      break;
    case ChangeKind::split:
      patch.vertices.back() = add_vertex(m, h);
      t.split(h);
      break;
    case ChangeKind::merge:
      t.collapse(h, change.stays == 0 ? t.from(h) : t.to(h));
      break;
  }
  move_vertices(patch, m.placement);
}

}  // namespace hooke
