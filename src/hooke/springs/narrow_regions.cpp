#include "hooke/springs/narrow_regions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <queue>
#include <tuple>

#include "hooke/mesh/wedges.h"

namespace hooke {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Finds the narrow regions of a mesh cut open along its creases, so that its boundary edges, the rims, are
/// all there is to look at. Every vertex near a rim knows its closest edge; at faces whose corners know
/// different ones a region may end on both sides.
class RegionSearch {
 public:
  RegionSearch(const Mat3X& points, const Adjacency& cut, const std::vector<double>& longest, double shortest)
      : points_(points),
        cut_(cut),
        longest_(longest),
        shortest_(shortest),
        inward_(Mat3X::Zero(3, std::ssize(cut.edges))),
        closest_(cut.vertex_count) {
    for (std::size_t e = 0; e < cut.edges.size(); ++e)
      if (cut.is_boundary_edge(static_cast<int>(e))) rim_edges_.push_back(static_cast<int>(e));
    for (int e : rim_edges_) inward_.col(e) = inward_normal(e);
    walk_rims();
    find_closest_edges();
  }

  /// The widths.
  std::vector<PlacedLength> run() {
    for (const Triangle& t : cut_.faces) look_across(t);
    for (int e : rim_edges_) {
      look_along(e, points_.col(cut_.edges[e][0]), points_.col(cut_.edges[e][1]));
      look_around(e);
    }
    return std::move(found_);
  }

 private:
  /// From the start of an edge to its end.
  Vec3 direction(int edge) const {
    return points_.col(cut_.edges[edge][1]) - points_.col(cut_.edges[edge][0]);
  }

  /// In the plane of the only face of a boundary edge, across the edge.
  Vec3 inward_normal(int edge) const {
    const Edge& ends = cut_.edges[edge];
    const Vec3 along = direction(edge).normalized();
    const Triangle& t = cut_.faces[cut_.edge_faces[edge][0]];
    const int apex = *std::ranges::find_if(t, [&](int v) { return v != ends[0] && v != ends[1]; });
    const Vec3 to_apex = points_.col(apex) - points_.col(ends[0]);
    return (to_apex - to_apex.dot(along) * along).normalized();
  }

  Vec3 closest_on(int edge, const Vec3& x) const {
    const Vec3 a = points_.col(cut_.edges[edge][0]), way = direction(edge);
    const double squared = way.squaredNorm();
    return squared > 0 ? Vec3(a + std::clamp((x - a).dot(way) / squared, 0., 1.) * way) : a;
  }

  /// Numbers the closed rims, and finds how far along them their edges begin. Edges of the boundary are
  /// directed as in their face.
  void walk_rims() {
    std::vector<int> from(cut_.vertex_count, -1);
    for (int e : rim_edges_) from[cut_.edges[e][0]] = e;
    next_.assign(cut_.edges.size(), -1);
    previous_ = rim_ = next_;
    for (int e : rim_edges_)
      if (const int next = from[cut_.edges[e][1]]; next >= 0) {
        next_[e] = next;
        previous_[next] = e;
      }
    start_.assign(cut_.edges.size(), 0);
    for (int first : rim_edges_) {
      if (rim_[first] >= 0) continue;
      double way = 0;
      for (int e = first; e >= 0 && rim_[e] < 0; e = next_[e]) {
        rim_[e] = static_cast<int>(rim_length_.size());
        start_[e] = way;
        way += direction(e).norm();
      }
      rim_length_.push_back(way);
    }
  }

  /// The way along the rim between points on two edges; infinite for two rims.
  double way_along_rim(int s, const Vec3& p, int t, const Vec3& q) const {
    if (rim_[s] != rim_[t]) return infinity;
    const auto place = [&](int e, const Vec3& x) {
      return start_[e] + (x - points_.col(cut_.edges[e][0])).norm();
    };
    const double way = std::abs(place(s, p) - place(t, q));
    return std::min(way, rim_length_[rim_[s]] - way);
  }

  /// Dijkstra's algorithm from the rims, no farther than the target lengths.
  void find_closest_edges() {
    using Item = std::tuple<double, int, int>;  // distance, vertex, edge
    std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
    const auto spread = [&](int v, int edge) {
      for (int w : cut_.vertex_neighbours[v]) {
        if (!closest_[w].empty()) continue;
        const double distance = (points_.col(w) - closest_on(edge, points_.col(w))).norm();
        if (distance < longest_[w]) queue.emplace(distance, w, edge);
      }
    };
    for (int e : rim_edges_)
      for (int v : cut_.edges[e]) closest_[v].push_back(e);
    for (int e : rim_edges_)
      for (int v : cut_.edges[e]) spread(v, e);
    while (!queue.empty()) {
      const auto [distance, v, edge] = queue.top();
      queue.pop();
      if (!closest_[v].empty()) continue;
      closest_[v].push_back(edge);
      spread(v, edge);
    }
  }

  void add(const Vec3& from, const Vec3& to, double width) {
    found_.push_back({from, to, std::max(width, shortest_)});
  }

  double longest_of(const Triangle& t) const {
    return std::min({longest_[t[0]], longest_[t[1]], longest_[t[2]]});
  }

  /// From an edge of a rim across x to the closest edge known at a face that faces it there; without one the
  /// width is infinite.
  PlacedLength across(const Triangle& t, const Vec3& x, int from) const {
    constexpr double facing = .5, times_around = 3;
    const Vec3 foot = closest_on(from, x);
    PlacedLength narrowest{foot, foot, infinity};
    for (int v : t)
      for (int to : closest_[v]) {
        if (to == from) continue;
        const Vec3 end = closest_on(to, x), way = end - foot;
        const double gap = way.norm(), width = (x - foot).norm() + (x - end).norm();
        if (width < narrowest.length && way.dot(inward_.col(from)) > facing * gap &&
            -way.dot(inward_.col(to)) > facing * gap &&
            way_along_rim(from, foot, to, end) > times_around * gap)
          narrowest = {foot, end, width};
      }
    return narrowest;
  }

  void look_across(const Triangle& t) {
    for (int v : t)
      for (int from : closest_[v])
        if (const PlacedLength s = across(t, points_.col(v), from); s.length < longest_of(t))
          add(s.from, s.to, s.length);
  }

  /// At pieces of a rim's edge, no longer than the region is wide there. Pieces in a row that are about as
  /// wide make one segment.
  void look_along(int edge, const Vec3& a, const Vec3& b) {
    const Triangle& t = cut_.faces[cut_.edge_faces[edge][0]];
    const Vec3 middle = .5 * (a + b);
    const double piece = (b - a).norm(), longest = longest_of(t), width = across(t, middle, edge).length;
    if (piece > std::max(shortest_, std::min(width, .5 * longest))) {
      look_along(edge, a, middle);
      look_along(edge, middle, b);
    } else if (width < longest) {
      PlacedLength* const last = found_.empty() ? nullptr : &found_.back();
      if (last && last->to == a &&
          PlacedLengths::power_of(last->length, shortest_) ==
              PlacedLengths::power_of(std::max(width, shortest_), shortest_))
        last->to = b;
      else
        add(a, b, width);
    }
  }

  /// The turn of a rim from an edge to the next one, radians.
  double turn_after(int edge) const {
    const Vec3 before = direction(edge), after = direction(next_[edge]);
    return std::atan2(before.cross(after).norm(), before.dot(after));
  }

  /// How far a rim gets along this way from the end of an edge, on the edges after it or, backward, from that
  /// edge on; no way past a corner, nor past half the rim.
  Vec3 way_from(int edge, double length, bool forward) const {
    length = std::min(length, .5 * rim_length_[rim_[edge]]);
    Vec3 way = Vec3::Zero();
    for (int e = forward ? next_[edge] : edge; e >= 0; e = forward ? next_[e] : previous_[e]) {
      const Vec3 step = forward ? direction(e) : Vec3(-direction(e));
      if (step.norm() >= length) return way + length * step.normalized();
      length -= step.norm();
      way += step;
      const int last = forward ? e : previous_[e];
      if (last < 0 || next_[last] < 0 || turn_after(last) > greatest_turn) break;
    }
    return Vec3::Zero();
  }

  /// At the end of a rim's edge, where the rim may be round: it must turn by as much as there along an eighth
  /// of a circle on both sides, so that kinks, corners and noise are not taken for that.
  void look_around(int edge) {
    constexpr double eighth = std::numbers::pi / 4, kept_share = 2. / 3;
    if (next_[edge] < 0) return;
    const int v = cut_.edges[edge][1];
    const double turn = turn_after(edge),
                 radius = .5 * (direction(edge).norm() + direction(next_[edge]).norm()) / turn;
    if (!(turn < greatest_turn && radius < longest_[v])) return;
    const Vec3 back = way_from(edge, eighth * radius, false), ahead = way_from(edge, eighth * radius, true);
    const double turned = std::atan2(back.cross(ahead).norm(), -back.dot(ahead));
    if (!back.isZero(0) && !ahead.isZero(0) && turned >= kept_share * eighth)
      add(points_.col(v), points_.col(v), radius);
  }

  static constexpr double greatest_turn = 60.5 * std::numbers::pi / 180;  // of a round rim: a hexagon's

  const Mat3X& points_;
  const Adjacency& cut_;
  const std::vector<double>& longest_;
  const double shortest_;
  std::vector<int> rim_edges_;
  Mat3X inward_;  // per edge, of those on a rim
  std::vector<int> next_, previous_,
      rim_;  // per edge, of those on a rim: the adjacent ones, the number of the rim
  std::vector<double> start_, rim_length_;  // per edge, per rim
  std::vector<std::vector<int>> closest_;   // per vertex: its own edges of rims, or the closest one
  std::vector<PlacedLength> found_;
};

}  // namespace

std::vector<PlacedLength> lengths_of_narrow_regions(const Mat3X& points, const Adjacency& c,
                                                    const std::vector<double>& vertex_length,
                                                    double shortest) {
  const Adjacency cut = cut_open(c);
  std::vector<double> longest(cut.vertex_count);
  for (int w = 0; w < cut.vertex_count; ++w) longest[w] = vertex_length[c.vertex_of_wedge(w)];
  return RegionSearch(wedge_points(points, c), cut, longest, shortest).run();
}

}  // namespace hooke
