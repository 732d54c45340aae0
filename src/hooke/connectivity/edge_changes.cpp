#include "hooke/connectivity/edge_changes.h"

#include <algorithm>
#include <limits>

namespace hooke {
namespace {

class Choice {
 public:
  Choice(const AdaptingMesh& mesh, const ChangeRules& rules)
      : m_(mesh), flipping_(mesh.flipping()), t_(mesh.triangulation), rules_(rules) {}

  std::vector<EdgeChange> changes(int h) const {
    std::vector<EdgeChange> changes;
    if (may_flip(h)) changes.push_back({h, ChangeKind::flip});
    if (rules_.splits && may_split(h)) changes.push_back({h, ChangeKind::split});
    if (rules_.merges && may_merge(h)) changes.push_back(merge(h));
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
    return may_change(Triangulation::previous(h)) && may_change(Triangulation::previous(t_.twin(h)));
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

  bool may_merge(int h) const {
    const int g = t_.twin(h), a = t_.from(h), b = t_.to(h);
    if (!may_go(a) && !may_go(b)) return false;
    if (!may_go(a) && !may_take_up(h, g)) return false;
    if (!may_go(b) && !may_take_up(g, h)) return false;
    return t_.valence(a) + t_.valence(b) - 4 <= rules_.valence && t_.may_collapse(h) &&
           at_both_apexes(h, [this](int corner) { return may_lose_an_edge(corner); });
  }

  /// Of two alike that one stays which has been there longer, and goes to the middle.
  EdgeChange merge(int h) const {
    const int a = t_.from(h), b = t_.to(h);
    const auto rank = [this](int v) {
      const int origin = m_.origins[static_cast<size_t>(v)];
      return std::tuple(may_go(v), origin < 0, origin < 0 ? v : origin);
    };
    return {h, ChangeKind::merge, rank(a) < rank(b) ? 0 : 1, may_go(a) && may_go(b)};
  }

  const AdaptingMesh& m_;
  const FlippingMesh flipping_;
  const Triangulation& t_;
  const ChangeRules& rules_;
};

/// A vertex that is at one end of the edge goes half the way to the other.
void move_half_way(EdgePatch& patch, int vertex, int to, const Surface& surface,
                   const RetractionOptions& options) {
  const Vec3 way = .5 * (patch.placement.points.col(to) - patch.placement.points.col(vertex));
  Retraction retraction(surface, patch.constraints, options);
  retraction.moved(patch.placement, vertex, way).write_to(patch.placement, vertex);
}

/// Appends the vertex in the middle of the edge. Returns its id.
int add_middle(EdgePatch& patch, const Surface& surface, const RetractionOptions& options) {
  const int v = append_vertex(patch, 0);
  move_half_way(patch, v, 1, surface, options);
  return v;
}

void merge_ends(EdgePatch& patch, const EdgeChange& merge, const Surface& surface,
                const RetractionOptions& options) {
  const int goes = 1 - merge.stays;
  if (merge.half_way) move_half_way(patch, merge.stays, goes, surface, options);
  patch.constraints.freedom[static_cast<size_t>(goes)] = Freedom::fixed;
}

}  // namespace

std::vector<int> inner_edges_about(const Triangulation& t, int face) {
  std::vector<int> edges;
  for (int corner : t.faces()[static_cast<size_t>(face)])
    for (int spoke : t.outgoing(corner))
      for (int h : {spoke, Triangulation::next(spoke), Triangulation::previous(spoke)})
        if (!t.is_border(h)) edges.push_back(std::min(h, t.twin(h)));
  std::ranges::sort(edges);
  const auto rest = std::ranges::unique(edges);
  edges.erase(rest.begin(), rest.end());
  return edges;
}

std::vector<EdgeChange> allowed_changes(const AdaptingMesh& m, int half_edge, const ChangeRules& rules) {
  return Choice(m, rules).changes(half_edge);
}

std::vector<Triangle> change_patch(EdgePatch& patch, const EdgeChange& change, const Surface& surface,
                                   const RetractionOptions& options) {
  switch (change.kind) {
    case ChangeKind::flip:
      break;
    case ChangeKind::split:
      return halved_faces(patch, add_middle(patch, surface, options));
    case ChangeKind::merge:
      merge_ends(patch, change, surface, options);
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
