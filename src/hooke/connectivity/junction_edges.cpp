#include "hooke/connectivity/junction_edges.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <span>

#include "hooke/connectivity/edge_splits.h"
#include "hooke/constraints/junction_curves.h"
#include "hooke/core/lists.h"
#include "hooke/mesh/halfedge_mesh.h"
#include "hooke/working_mesh/working_mesh.h"

namespace hooke {
namespace {

/// An edge of a junction, with its half-edge of each sheet as the vertices from which and to which it runs.
struct SharedEdge {
  Edge ends;  // numbers, smaller one first
  int curve;
  std::vector<Edge> sides;
  double length = 0;  // over the target length, the largest of its sheets
};

std::vector<SharedEdge> shared_edges(const WorkingMesh& m) {
  const HalfedgeMesh& t = m.halfedges;
  const Constraints& c = m.vertices.constraints;
  std::vector<SharedEdge> edges;
  for (const JunctionEdge& e : c.junction_edges) edges.push_back({e.ends, e.curve, {}});
  for (int h = 0; h < t.half_edge_count(); ++h) {
    if (t.is_removed(h / 3) || t.twin(h) > h || !is_junction_edge(m, h)) continue;
    const auto [low, high] = std::minmax(c.junction[t.from(h)], c.junction[t.to(h)]);
    SharedEdge& edge = *std::ranges::lower_bound(edges, Edge{low, high}, {}, &SharedEdge::ends);
    edge.sides.push_back({t.from(h), t.to(h)});
    edge.length = std::max(edge.length, relative_length(m, h));
  }
  return edges;
}

}  // namespace

CurveEdges count_junction_edges(const WorkingMesh& m, double chord_error) {
  const Constraints& c = m.vertices.constraints;
  CurveEdges count;
  std::vector<double> lengths(c.junction_curves.size(), 0);  // sum of the target lengths of the edges
  count.present.assign(lengths.size(), 0);
  count.target.assign(lengths.size(), 0);
  for (const SharedEdge& edge : shared_edges(m)) {
    double length = 0;
    for (const auto& [a, b] : edge.sides) length += target_length(m, a, b);
    lengths[edge.curve] += length / static_cast<double>(edge.sides.size());
    ++count.present[edge.curve];
  }
  for (std::size_t k = 0; k < lengths.size(); ++k)
    if (count.present[k] > 0)
      count.target[k] = target_edge_count(c.junction_curves[k], lengths[k] / count.present[k], chord_error);
  return count;
}

namespace {

class JunctionMatch {
 public:
  JunctionMatch(WorkingMesh& m, double chord_error, const CollapseOptions& collapse)
      : m_(m),
        t_(m.halfedges),
        c_(m.vertices.constraints),
        collapse_(collapse),
        count_(count_junction_edges(m, chord_error)) {}

  CountChanges run() {
    CountChanges changes;
    while (const int splits = split_pass()) changes.splits += splits;
    copies_ = copies_of_junctions(c_);
    while (const int collapses = collapse_pass()) changes.collapses += collapses;
    m_.retraction.count();
    return changes;
  }

 private:
  int lacking(int curve) const { return count_.target[curve] - count_.present[curve]; }

  // Splits.

  int split_pass() {
    std::vector<SharedEdge> edges = shared_edges(m_);
    std::ranges::stable_sort(edges, std::ranges::greater(), &SharedEdge::length);
    std::vector<JunctionEdge> next;
    int splits = 0;
    for (const SharedEdge& edge : edges) {
      const bool is_wanted = edge.length > max_relative_length || lacking(edge.curve) > 0;
      const int middle = is_wanted ? split(edge) : -1;
      if (middle < 0) {
        next.push_back({edge.ends, edge.curve});
        continue;
      }
      for (const int end : edge.ends) next.push_back({{end, middle}, edge.curve});
      ++count_.present[edge.curve];
      ++splits;
    }
    replace_edges(std::move(next));
    return splits;
  }

  void replace_edges(std::vector<JunctionEdge> edges) {
    std::ranges::sort(edges, {}, &JunctionEdge::ends);
    c_.junction_edges = std::move(edges);
  }

  Vec3 point(int vertex) const { return m_.vertices.positions.points.col(vertex); }

  /// Segment of its curve on which to search for the middle of an edge: that of an end on the curve, or one
  /// halfway.
  int segment_of(const SharedEdge& edge) const {
    for (const int v : edge.sides.front())
      if (c_.junction_vertex(v)->curve >= 0) return m_.vertices.positions.segments[v];
    return c_.junction_curves[edge.curve].segment_count() / 2;
  }

  /// Splits the edge in all its sheets. Returns the number of the new vertices, -1 if a sheet forbids it.
  int split(const SharedEdge& edge) {
    const auto [a, b] = edge.sides.front();
    if (c_.is_frozen(a, b)) return -1;
    const Vec3 chord = .5 * point(a) + .5 * point(b);
    const CurveProjection middle = project_to_curve(c_.junction_curves[edge.curve], chord, segment_of(edge));
    constexpr double rounding = 1e-9, most = .9;  // of the length of the edge
    const double length = (point(b) - point(a)).norm();
    if (std::max((middle.point - point(a)).norm(), (middle.point - point(b)).norm()) > most * length)
      return -1;
    const bool bends = (middle.point - chord).norm() > rounding * length;
    if (bends && !std::ranges::all_of(edge.sides, [&](const Edge& side) { return may_split(side, middle); }))
      return -1;
    const int number = static_cast<int>(c_.junction_vertices.size());
    c_.junction_vertices.push_back({edge.curve, true});
    for (const auto& [from, to] : edge.sides) {
      const int h = t_.half_edge(from, to), v = add(h, middle);
      c_.junction[v] = number;
      t_.split(h);
      t_.mark_junction(v, number);
    }
    return number;
  }

  int add(int h, const CurveProjection& middle) {
    const int v = add_vertex(m_, h);
    m_.vertices.positions.points.col(v) = middle.point;
    m_.vertices.positions.segments[v] = middle.segment;
    c_.freedom[v] = Freedom::fixed;
    c_.curve[v] = -1;
    return v;
  }

  bool may_split(const Edge& side, const CurveProjection& middle) {
    const int h = t_.half_edge(side[0], side[1]), twin = t_.twin(h), v = add(h, middle);
    const bool allowed = may_split_face(m_, h, v, v) && (twin < 0 || may_split_face(m_, twin, v, v + 1));
    remove_last_vertex(m_);
    return allowed;
  }

  // Collapses.

  int collapse_pass() {
    std::vector<SharedEdge> edges = shared_edges(m_);
    std::ranges::stable_sort(edges, {}, &SharedEdge::length);
    std::vector<int> now(c_.junction_vertices.size());  // the number that each has become
    for (std::size_t n = 0; n < now.size(); ++n) now[n] = static_cast<int>(n);
    std::vector<char> is_touched(now.size(), 0);
    std::vector<JunctionEdge> next;
    int collapses = 0;
    for (const SharedEdge& edge : edges) {
      const auto [a, b] = edge.ends;
      const bool is_wanted = lacking(edge.curve) < 0 && !is_touched[a] && !is_touched[b];
      const int stays = is_wanted ? collapse(edge) : -1;
      if (stays < 0) {
        next.push_back({edge.ends, edge.curve});
        continue;
      }
      now[stays == a ? b : a] = stays;
      is_touched[a] = is_touched[b] = 1;
      --count_.present[edge.curve];
      ++collapses;
    }
    for (auto& [ends, curve] : next) {
      const auto [low, high] = std::minmax(now[ends[0]], now[ends[1]]);
      ends = {low, high};
    }
    replace_edges(std::move(next));
    return collapses;
  }

  /// Collapses the edge in all its sheets. Returns the number of the remaining vertex, -1 if that is not
  /// allowed.
  int collapse(const SharedEdge& edge) {
    const auto [a, b] = edge.ends;
    if ((!slides(a) && !slides(b)) || !keeps_topology(edge)) return -1;
    const int stays = slides(a) && !slides(b) ? b : a, goes = stays == a ? b : a;
    static constexpr std::array anywhere = {.5, 0., 1.};
    const bool both = slides(a) && slides(b);
    for (const double fraction : std::span(anywhere).subspan(both ? 0 : 1, both ? 3 : 1)) {
      const std::vector<SurfacePosition> at = positions(edge, stays, fraction);
      if (!may_collapse(edge, stays, at)) continue;
      for (std::size_t i = 0; i < edge.sides.size(); ++i) {
        const auto [vertex, other] = ends_of(edge.sides[i], stays);
        t_.collapse(t_.half_edge(edge.sides[i][0], edge.sides[i][1]), vertex);
        at[i].write_to(m_.vertices.positions, vertex);
        c_.junction[other] = -1;
      }
      c_.junction_vertices[goes] = {};
      return stays;
    }
    return -1;
  }

  bool slides(int number) const { return c_.junction_vertices[number].slides; }

  /// The end with this number, and the other one.
  Edge ends_of(const Edge& side, int number) const {
    return c_.junction[side[0]] == number ? side : Edge{side[1], side[0]};
  }

  /// Of the vertices that stay, in each sheet.
  std::vector<SurfacePosition> positions(const SharedEdge& edge, int stays, double fraction) {
    std::vector<SurfacePosition> at;
    const int first = ends_of(edge.sides.front(), stays)[0];
    for (const Edge& side : edge.sides) {
      const auto [vertex, other] = ends_of(side, stays);
      if (fraction > 0)
        at.push_back(m_.retraction.slid(m_.vertices.positions, vertex, first,
                                        fraction * (point(other) - point(vertex))));
      else
        at.emplace_back(m_.vertices.positions, vertex);
    }
    return at;
  }

  bool may_collapse(const SharedEdge& edge, int stays, const std::vector<SurfacePosition>& at) const {
    for (std::size_t i = 0; i < at.size(); ++i) {
      const auto [from, to] = edge.sides[i];
      if (!may_collapse_to(m_, t_.half_edge(from, to), ends_of(edge.sides[i], stays)[0], at[i], collapse_))
        return false;
    }
    return true;
  }

  /// The id of a vertex in the joined mesh.
  int id(int vertex) const {
    const int number = c_.junction[vertex];
    return number >= 0 ? number : static_cast<int>(c_.junction_vertices.size()) + vertex;
  }

  /// Neighbours and opposite edges of a vertex in the joined mesh; sorted.
  struct Link {
    std::vector<int> vertices;
    std::vector<Edge> edges;
  };

  Link link_of(int number) const {
    Link link;
    for (const int v : copies_[number])
      for (const int h : t_.outgoing(v)) {
        const int p = id(t_.to(h)), q = id(t_.opposite_vertex(h));
        link.vertices.insert(link.vertices.end(), {p, q});
        link.edges.push_back({std::min(p, q), std::max(p, q)});
      }
    std::ranges::sort(link.edges);
    sort_unique(link.vertices);
    return link;
  }

  /// The link condition in the joined mesh: the ends have no common neighbours but the vertices opposite the
  /// edge, one of each face, and no common opposite edge. See T. K. Dey et al., "Topology preserving edge
  /// contraction", 1999; the ends are joined by a junction, so that it is enough that the edges of junctions
  /// pass the same test in each sheet.
  bool keeps_topology(const SharedEdge& edge) const {
    std::vector<int> opposite;
    for (const auto& [from, to] : edge.sides) {
      const int h = t_.half_edge(from, to);
      opposite.push_back(id(t_.opposite_vertex(h)));
      if (t_.twin(h) >= 0) opposite.push_back(id(t_.opposite_vertex(t_.twin(h))));
    }
    std::ranges::sort(opposite);
    if (std::ranges::adjacent_find(opposite) != opposite.end()) return false;
    const Link a = link_of(edge.ends[0]), b = link_of(edge.ends[1]);
    std::vector<int> common;
    std::ranges::set_intersection(a.vertices, b.vertices, std::back_inserter(common));
    std::vector<Edge> common_edges;
    std::ranges::set_intersection(a.edges, b.edges, std::back_inserter(common_edges));
    return common == opposite && common_edges.empty();
  }

  WorkingMesh& m_;
  HalfedgeMesh& t_;
  Constraints& c_;
  const CollapseOptions& collapse_;
  CurveEdges count_;
  IntLists copies_;
};

}  // namespace

CountChanges match_junction_edges(WorkingMesh& m, double chord_error, const CollapseOptions& collapse) {
  if (m.vertices.constraints.junction_edges.empty()) return {};
  return JunctionMatch(m, chord_error, collapse).run();
}

}  // namespace hooke
