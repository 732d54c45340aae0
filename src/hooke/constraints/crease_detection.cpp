#include "hooke/constraints/crease_detection.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "hooke/core/parallel.h"
#include "hooke/mesh/normals.h"

namespace hooke {
namespace {

size_t idx(int i) {
  return static_cast<size_t>(i);
}

/// Angle in degrees between the normals of the two faces of each edge; 0 on the boundary and beside faces
/// without area.
std::vector<double> edge_angles(const Mat3X& points, const Adjacency& c) {
  const Mat3X normals = face_normals(points, c);
  std::vector<double> angles(c.edges.size(), 0);
  parallel_for(angles.size(), 4096, [&](size_t begin, size_t end) {
    for (size_t e = begin; e < end; ++e) {
      if (c.is_boundary_edge(static_cast<int>(e))) continue;
      const Vec3 a = normals.col(c.edge_faces[e][0]), b = normals.col(c.edge_faces[e][1]);
      angles[e] = std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
    }
  });
  return angles;
}

class FeatureSearch {
 public:
  FeatureSearch(const Mat3X& points, const Adjacency& c, const std::vector<double>& length,
                const CreaseOptions& o)
      : X_(points),
        c_(c),
        length_(length),
        o_(o),
        angle_(edge_angles(points, c)),
        kept_(c.edges.size(), 0),
        cos_turn_(std::cos(o.max_turn * std::numbers::pi / 180)) {}

  std::vector<int> run() {
    if (grow() > 0) {
      drop_loose_chains();
      drop_noise();
    }
    std::vector<int> edges;
    for (size_t e = 0; e < kept_.size(); ++e)
      if (kept_[e]) edges.push_back(static_cast<int>(e));
    return edges;
  }

 private:
  /// Bend ratio of the edge, see CreaseOptions. Boundary edges count as flat or, with `goes_on`, where the
  /// surface evidently continues, are left out.
  double bend_ratio(int edge, bool goes_on = false) const {
    double worst = 0;
    for (int f : c_.edge_faces[idx(edge)]) {
      double smallest = 180;
      for (int e : c_.face_edges[idx(f)])
        if (e != edge && !(goes_on && c_.is_boundary_edge(e))) smallest = std::min(smallest, angle_[idx(e)]);
      worst = std::max(worst, smallest);
    }
    return worst / angle_[idx(edge)];
  }

  bool may_belong(int edge, double min_angle) const {
    return angle_[idx(edge)] > min_angle && bend_ratio(edge) <= o_.max_bend_ratio;
  }

  int other_end(int edge, int vertex) const {
    const Edge& e = c_.edges[idx(edge)];
    return e[0] == vertex ? e[1] : e[0];
  }

  double length(int edge) const {
    const auto& [a, b] = c_.edges[idx(edge)];
    return (X_.col(a) - X_.col(b)).norm() / (.5 * (length_[idx(a)] + length_[idx(b)]));
  }

  /// Whether the chain continues nearly straight at the vertex.
  bool goes_on(int edge, int next, int vertex) const {
    const Vec3 in = X_.col(vertex) - X_.col(other_end(edge, vertex));
    const Vec3 out = X_.col(other_end(next, vertex)) - X_.col(vertex);
    return in.dot(out) >= cos_turn_ * in.norm() * out.norm();
  }

  /// Marks the sharp edges and the weaker ones that continue them. Returns their number.
  size_t grow() {
    size_t count = 0;
    std::vector<int> front;
    for (size_t e = 0; e < kept_.size(); ++e)
      if (may_belong(static_cast<int>(e), o_.angle)) {
        kept_[e] = 1;
        front.push_back(static_cast<int>(e));
      }
    while (!front.empty()) {
      const int edge = front.back();
      front.pop_back();
      ++count;
      for (int v : c_.edges[idx(edge)])
        for (int next : c_.vertex_edges[v]) {
          if (kept_[idx(next)] || !may_belong(next, o_.hysteresis * o_.angle) || !goes_on(edge, next, v))
            continue;
          kept_[idx(next)] = 1;
          front.push_back(next);
        }
    }
    return count;
  }

  std::vector<int> kept_edges(int vertex) const {
    std::vector<int> edges;
    for (int e : c_.vertex_edges[vertex])
      if (kept_[idx(e)]) edges.push_back(e);
    return edges;
  }

  struct Chain {
    std::vector<int> edges;
    int first, last;  // vertices
  };

  /// The chain from a vertex to where it meets another chain, turns, or ends.
  Chain chain_from(int vertex, int edge) const {
    Chain chain{{edge}, vertex, other_end(edge, vertex)};
    for (;;) {
      const std::vector<int> here = kept_edges(chain.last);
      if (here.size() != 2) return chain;
      const int next = here[0] == edge ? here[1] : here[0];
      if (!goes_on(edge, next, chain.last)) return chain;
      chain.edges.push_back(edge = next);
      chain.last = other_end(edge, chain.last);
    }
  }

  double median_bend_ratio(const std::vector<int>& edges, bool goes_on = false) const {
    std::vector<double> ratios;
    for (int e : edges) ratios.push_back(bend_ratio(e, goes_on));
    const auto middle = ratios.begin() + std::ssize(ratios) / 2;
    std::nth_element(ratios.begin(), middle, ratios.end());
    return *middle;
  }

  bool on_boundary(int vertex) const {
    const auto edges = c_.vertex_edges[vertex];
    return std::any_of(edges.begin(), edges.end(), [&](int e) { return c_.is_boundary_edge(e); });
  }

  bool is_loose(int vertex) const { return kept_edges(vertex).size() == 1 && !on_boundary(vertex); }

  /// Noise makes short chains and chains that begin and end in the interior of the surface. A chain from the
  /// boundary to another crease or to the boundary, sharp between flat faces, may be short: the corner of an
  /// open box, the fold of a strip. A single edge may not: it could be the edge of a loose triangle.
  bool is_worth_keeping(const Chain& chain) const {
    double sum = 0;
    int sharp = 0;
    for (int e : chain.edges) {
      sum += length(e);
      sharp += angle_[idx(e)] > o_.angle;
    }
    const auto edges = static_cast<int>(chain.edges.size());
    const double ratio = median_bend_ratio(chain.edges);
    if (on_boundary(chain.first) && edges > 1 && sharp == edges) {
      if (kept_edges(chain.last).size() > 1 && ratio <= o_.flat_bend_ratio) return true;
      if (on_boundary(chain.last) && median_bend_ratio(chain.edges, true) <= o_.flat_bend_ratio) return true;
    }
    const bool is_lone = is_loose(chain.first) && is_loose(chain.last);
    return edges >= o_.min_edges && sum >= o_.min_length && sharp >= o_.sharp_share * edges &&
           ratio <= (is_lone ? o_.flat_bend_ratio : o_.max_chain_bend_ratio);
  }

  void drop_loose_chains() {
    std::vector<int> ends;
    for (int v = c_.vertex_count; v-- > 0;) ends.push_back(v);
    while (!ends.empty()) {
      const int v = ends.back();
      ends.pop_back();
      const std::vector<int> here = kept_edges(v);
      if (here.size() != 1) continue;
      const Chain chain = chain_from(v, here[0]);
      if (is_worth_keeping(chain)) continue;
      for (int e : chain.edges) kept_[idx(e)] = 0;
      ends.push_back(chain.last);
    }
  }

  /// All kept edges connected with this one.
  std::vector<int> network_of(int edge, std::vector<char>& seen) const {
    std::vector<int> network = {edge};
    seen[idx(edge)] = 1;
    for (size_t i = 0; i < network.size(); ++i)
      for (int v : c_.edges[idx(network[i])])
        for (int e : kept_edges(v))
          if (!std::exchange(seen[idx(e)], 1)) network.push_back(e);
    return network;
  }

  /// Number of edges that end at a corner, counted at both ends.
  int curve_ends(const std::vector<int>& network) const {
    int ends = 0;
    for (int e : network)
      for (int v : c_.edges[idx(e)]) {
        const std::vector<int> here = kept_edges(v);
        ends += here.size() != 2 || !goes_on(here[0], here[1], v);
      }
    return ends;
  }

  void drop_noise() {
    std::vector<char> seen(kept_.size(), 0);
    for (size_t e = 0; e < kept_.size(); ++e) {
      if (!kept_[e] || seen[e]) continue;
      const std::vector<int> network = network_of(static_cast<int>(e), seen);
      const bool short_curves = 2 * static_cast<double>(network.size()) < o_.min_curve * curve_ends(network);
      if (short_curves && median_bend_ratio(network) > o_.flat_bend_ratio)
        for (int i : network) kept_[idx(i)] = 0;
    }
  }

  const Mat3X& X_;
  const Adjacency& c_;
  const std::vector<double>& length_;
  const CreaseOptions& o_;
  std::vector<double> angle_;
  std::vector<char> kept_;
  double cos_turn_;
};

}  // namespace

std::vector<int> detect_creases(const Mat3X& points, const Adjacency& adjacency,
                                const std::vector<double>& vertex_length, const CreaseOptions& options) {
  if (options.angle >= 180) return {};
  return FeatureSearch(points, adjacency, vertex_length, options).run();
}

}  // namespace hooke
