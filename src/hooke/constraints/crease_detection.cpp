#include "hooke/constraints/crease_detection.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "hooke/constraints/facet_creases.h"
#include "hooke/constraints/zigzag_strips.h"
#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/curvature.h"
#include "hooke/mesh/disjoint_sets.h"
#include "hooke/mesh/image_surfaces.h"
#include "hooke/mesh/normals.h"

namespace hooke {
namespace {

// The bend ratio of an edge compares the flattest continuation of its faces with the edge itself: for each
// face the smaller angle at its two other edges over the angle at the edge; the larger of both faces.
constexpr double hysteresis = .6;  // fraction of the sharp angle above which an edge may continue a crease
constexpr double max_turn = 35;    // degrees; maximum change of direction from edge to edge of a chain
constexpr double max_bend_ratio = .25;          // of a crease edge; above it the surface is round
constexpr double max_round_bend_ratio = .6;     // the same where sharp edges stand out from all others
constexpr double max_going_on_bend_ratio = .5;  // of a sharp edge that continues a crease
constexpr double max_chain_bend_ratio = .1;     // maximum median bend ratio of a chain with a loose end
constexpr double sharp_share = .3;              // minimum fraction of sharp edges in a chain with a loose end
constexpr int min_edges = 12;            // minimum number of edges of such a chain, unless it stands out
constexpr double min_length = 8;         // and its minimum length, in target lengths
constexpr double unlikely = 1e-4;        // expected number of chains of noise with one loose end or none
constexpr double unlikely_lone = 1e-8;   // the same with two
constexpr double clear_sharpness = 1.5;  // minimum mean angle, over `angle`, of a chain that stands out
constexpr double flat_bend_ratio = .02;  // maximum median bend ratio of a chain or network between flat faces
constexpr double min_curve =
    5;  // minimum mean number of edges between corners of a network that is not clear
constexpr double facet_angle =
    1.4;  // minimum angle at all edges of a face that is a facet of its own, over `angle`
// The edge of a blade: edges much longer than the target, of which those that turn back are `min_length` in
// all.
constexpr double blade_angle = 120;  // degrees; beyond it the surface turns back
constexpr double blade_length = 3;   // minimum length of each edge, in target lengths
constexpr double blade_area = .75;   // minimum area of the faces beside it, in squared target lengths

// Bevels of an isosurface, each of two edges that bend by a part of the angle of the body's edge: at a right
// angle by about 45 degrees, or by up to 60 where it lies askew in the grid.
constexpr double sliver_angle = 20;         // degrees; faces of bevels with smaller ones
constexpr double max_sliver_share = .02;    // number of their corners, over the edges of a network
constexpr double sharper_than_bevels = 60;  // degrees

/// Angle in degrees between the normals of the two faces of each edge; 0 on the boundary and beside faces
/// without area.
std::vector<double> edge_angles(const Mat3X& normals, const Adjacency& c) {
  std::vector<double> angles(c.edges.size(), 0);
  parallel_for(angles.size(), 4096, [&](size_t begin, size_t end) {
    for (size_t e = begin; e < end; ++e) {
      const auto& [left, right] = c.edge_faces[e];
      if (right >= 0) angles[e] = angle_between(normals.col(left), normals.col(right));
    }
  });
  return angles;
}

/// The same, but 0 where zigzag strips fold, and beside these as between smooth strips.
std::vector<double> edge_angles_without_zigzags(const Mat3X& points, const Adjacency& c,
                                                const std::vector<double>& length) {
  Mat3X normals = certain_face_normals(points, c);
  const std::vector<char> is_fold = smooth_zigzag_strips(points, c, length, normals);
  std::vector<double> angles = edge_angles(normals, c);
  for (size_t e = 0; e < angles.size(); ++e)
    if (is_fold[e]) angles[e] = 0;
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
        angle_(o.drops_noise ? edge_angles_without_zigzags(points, c, length)
                             : edge_angles(certain_face_normals(points, c), c)),
        kept_(c.edges.size(), 0),
        cos_turn_(std::cos(max_turn * std::numbers::pi / 180)) {}

  /// Marks of the creases, by edge; with `of_facets` also those that flat facets tell. To be called once.
  std::vector<char> find(bool of_facets) {
    if (!o_.drops_noise) {
      for (size_t e = 0; e < kept_.size(); ++e) kept_[e] = angle_[e] > o_.angle;
    } else if (grow() > 0) {
      drop_loose_chains();
      drop_noise();
    }
    if (of_facets) add_facet_creases(X_, c_, length_, angle_, o_.angle, kept_);
    if (o_.drops_noise) {
      drop_accidents();
      add_blades();
    }
    return kept_;
  }

 private:
  /// Bend ratio of the edge, see above. Boundary edges count as flat or, with `goes_on`, where the
  /// surface evidently continues, are left out.
  double bend_ratio(int edge, bool goes_on = false) const {
    double worst = 0;
    for (int f : c_.edge_faces[edge]) {
      if (is_facet(f)) continue;
      double smallest = 180;
      for (int e : c_.face_edges[f])
        if (e != edge && !(goes_on && c_.is_boundary_edge(e))) smallest = std::min(smallest, angle_[e]);
      worst = std::max(worst, smallest);
    }
    return worst / angle_[edge];
  }

  /// Is the face a flat facet of its own: sharp on all sides, in a place where edges are sharp or flat?
  bool is_facet(int face) const {
    const auto is_sharp = [&](int e) { return c_.is_boundary_edge(e) || angle_[e] > facet_angle * o_.angle; };
    const auto is_flat = [&](int e) { return angle_[e] < flat_bend_ratio * o_.angle; };
    return std::ranges::all_of(c_.face_edges[face], is_sharp) &&
           std::ranges::all_of(c_.faces[face], [&](int v) {
             return std::ranges::all_of(c_.vertex_edges[v], [&](int e) { return is_sharp(e) || is_flat(e); });
           });
  }

  bool turns_back(int edge) const { return angle_[edge] > blade_angle; }

  /// Is the edge sharp, much longer than the target, and between faces of some area, which go on rather flat?
  bool may_be_of_blade(int edge) const {
    if (angle_[edge] <= o_.angle || c_.is_boundary_edge(edge)) return false;
    const double length = length_over_target(X_, c_, length_, edge);
    if (length <= blade_length ||
        bend_ratio(edge) > (turns_back(edge) ? max_chain_bend_ratio : max_bend_ratio))
      return false;
    const auto& [a, b] = c_.edges[edge];
    const double target = .5 * (length_[a] + length_[b]);
    return std::ranges::all_of(c_.edge_faces[edge], [&](int f) {
      return .5 * doubled_area_vector(X_, c_.faces[f]).norm() > blade_area * target * target;
    });
  }

  /// Adds the edges of blades, whose faces are curved and narrow: noise hardly makes edges in line that are
  /// so long and turn back, between faces that do not.
  void add_blades() {
    std::vector<char> seen = kept_;
    for (size_t seed = 0; seed < kept_.size(); ++seed) {
      if (seen[seed] || !turns_back(static_cast<int>(seed)) || !may_be_of_blade(static_cast<int>(seed)))
        continue;
      seen[seed] = 1;
      std::vector<int> network = {static_cast<int>(seed)};
      double sum = 0;
      for (size_t i = 0; i < network.size(); ++i) {
        if (turns_back(network[i])) sum += length_over_target(X_, c_, length_, network[i]);
        for (int v : c_.edges[network[i]])
          for (int next : c_.vertex_edges[v]) {
            if (seen[next] || !may_be_of_blade(next) || !goes_on(network[i], next, v)) continue;
            seen[next] = 1;
            network.push_back(next);
          }
      }
      if (sum >= min_length)
        for (int e : network) kept_[e] = 1;
    }
  }

  /// Drops single edges and, where most sharp edges are noise, small networks: faces that are folded over by
  /// noise have sharp edges all around.
  void drop_accidents() {
    int sharp = 0, kept = 0;
    for (size_t e = 0; e < kept_.size(); ++e)
      if (angle_[e] > o_.angle) {
        ++sharp;
        kept += kept_[e];
      }
    const bool is_noisy = 2 * kept < sharp;
    std::vector<char> seen(kept_.size(), 0);
    for (size_t e = 0; e < kept_.size(); ++e) {
      if (!kept_[e] || seen[e]) continue;
      const std::vector<int> network = network_of(static_cast<int>(e), seen);
      const bool is_single =
          network.size() == 1 && std::ranges::all_of(c_.edges[e], [&](int v) { return is_loose(v); });
      if (is_single || (is_noisy && std::ssize(network) < min_edges))
        for (int i : network) kept_[i] = 0;
    }
  }

  bool may_belong(int edge, double min_angle) const {
    const bool is_clear = sharp_stand_out_ && angle_[edge] > clear_sharpness * o_.angle;
    return angle_[edge] > min_angle && bend_ratio(edge) <= (is_clear ? max_round_bend_ratio : max_bend_ratio);
  }

  /// Are nearly all sharp edges far sharper than the others? Noise makes edges of all angles.
  bool sharp_edges_stand_out() const {
    constexpr double max_between = .01;
    const auto sharper = [&](double angle) {
      return static_cast<double>(std::ranges::count_if(angle_, [&](double a) { return a > angle; }));
    };
    const double clear = sharper(clear_sharpness * o_.angle);
    return sharper(o_.angle) - clear <= max_between * clear;
  }

  /// May the edge go on with a crease? If it is sharp, also where the surface beside it is rather round.
  bool may_continue(int edge) const {
    return may_belong(edge, hysteresis * o_.angle) ||
           (angle_[edge] > o_.angle && bend_ratio(edge) <= max_going_on_bend_ratio);
  }

  int other_end(int edge, int vertex) const {
    const Edge& e = c_.edges[edge];
    return e[0] == vertex ? e[1] : e[0];
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
      for (int v : c_.edges[edge])
        for (int next : c_.vertex_edges[v]) {
          if (kept_[next] || !may_continue(next) || !goes_on(edge, next, v)) continue;
          kept_[next] = 1;
          front.push_back(next);
        }
    }
    return count;
  }

  std::vector<int> kept_edges(int vertex) const {
    std::vector<int> edges;
    for (int e : c_.vertex_edges[vertex])
      if (kept_[e]) edges.push_back(e);
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
    ratios.reserve(edges.size());
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

  /// About how many such chains noise makes in the mesh: of the edges that it makes a tenth has a bend ratio
  /// below .04, and few have one above .4; those of faces that it folds over may have any.
  double expected_by_noise(const std::vector<int>& chain) const {
    constexpr double folded = 135;  // degrees
    auto number = static_cast<double>(c_.edges.size());
    for (int e : chain)
      if (angle_[e] < folded) number *= std::clamp(bend_ratio(e) / .4, .05, 1.);
    return number;
  }

  /// Are the edges, with this median bend ratio, very sharp or between flat faces, and hardly made by noise?
  bool stands_out(const std::vector<int>& edges, double ratio, bool is_lone = false) const {
    double sum = 0;
    for (int e : edges) sum += angle_[e];
    return (ratio <= flat_bend_ratio ||
            sum > clear_sharpness * o_.angle * static_cast<double>(edges.size())) &&
           expected_by_noise(edges) < (is_lone ? unlikely_lone : unlikely);
  }

  /// Noise makes short chains and chains that begin and end in the interior of the surface, unless they are
  /// very sharp or flat on both sides, and unlikely by chance: where round bodies meet. A chain from the
  /// boundary to another crease or to the boundary, sharp between flat faces, may be short: the corner of an
  /// open box, the fold of a strip. A single edge may not: it could be the edge of a loose triangle.
  bool is_worth_keeping(const Chain& chain) const {
    double sum = 0;
    int sharp = 0;
    for (int e : chain.edges) {
      sum += length_over_target(X_, c_, length_, e);
      sharp += angle_[e] > o_.angle;
    }
    const auto edges = static_cast<int>(chain.edges.size());
    const double ratio = median_bend_ratio(chain.edges);
    if (on_boundary(chain.first) && edges > 1 && sharp == edges) {
      if (kept_edges(chain.last).size() > 1 && ratio <= flat_bend_ratio) return true;
      if (on_boundary(chain.last) && median_bend_ratio(chain.edges, true) <= flat_bend_ratio) return true;
    }
    const bool is_lone = is_loose(chain.first) && is_loose(chain.last);
    if (sharp < sharp_share * edges) return false;
    if (stands_out(chain.edges, ratio, is_lone)) return true;
    return edges >= min_edges && sum >= min_length &&
           ratio <= (is_lone ? flat_bend_ratio : max_chain_bend_ratio);
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
      for (int e : chain.edges) kept_[e] = 0;
      ends.push_back(chain.last);
    }
  }

  /// All kept edges connected with this one.
  std::vector<int> network_of(int edge, std::vector<char>& seen) const {
    std::vector<int> network = {edge};
    seen[edge] = 1;
    for (size_t i = 0; i < network.size(); ++i)
      for (int v : c_.edges[network[i]])
        for (int e : kept_edges(v))
          if (!std::exchange(seen[e], 1)) network.push_back(e);
    return network;
  }

  /// Number of edges that end at a corner, counted at both ends.
  int curve_ends(const std::vector<int>& network) const {
    int ends = 0;
    for (int e : network)
      for (int v : c_.edges[e]) {
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
      const bool short_curves = 2 * static_cast<double>(network.size()) < min_curve * curve_ends(network);
      const double ratio = median_bend_ratio(network);
      const bool is_clear =
          ratio <= flat_bend_ratio || (ratio <= max_chain_bend_ratio && stands_out(network, ratio));
      if (short_curves && !is_clear)
        for (int i : network) kept_[i] = 0;
    }
  }

  const Mat3X& X_;
  const Adjacency& c_;
  const std::vector<double>& length_;
  const CreaseOptions& o_;
  std::vector<double> angle_;
  std::vector<char> kept_;
  double cos_turn_;
  bool sharp_stand_out_ = sharp_edges_stand_out();
};

/// Drops the networks of creases along bevels of slivers: of faces between two creases, with corners on these
/// only. Were there any?
bool drop_bevels(const Mat3X& points, const Adjacency& c, std::vector<char>& kept) {
  DisjointSets networks(static_cast<size_t>(c.vertex_count));
  std::vector<char> is_on_crease(c.vertex_count, 0);
  std::vector<int> edges(c.vertex_count, 0), slivers(c.vertex_count, 0);  // of the network by its root
  for (size_t e = 0; e < kept.size(); ++e) {
    if (!kept[e]) continue;
    networks.join(c.edges[e]);
    for (int v : c.edges[e]) is_on_crease[v] = 1;
  }
  for (size_t e = 0; e < kept.size(); ++e) edges[networks.root(c.edges[e][0])] += kept[e];
  const double sliver = cotangent_of(sliver_angle);
  for (size_t f = 0; f < c.faces.size(); ++f)
    if (std::ranges::all_of(c.faces[f], [&](int v) { return is_on_crease[v] != 0; }) &&
        std::ranges::any_of(c.face_edges[f], [&](int e) { return !kept[e]; }) &&
        max_cotangent(points, c.faces[f]) > sliver)
      for (int v : c.faces[f]) ++slivers[networks.root(v)];
  const std::vector<char> before = kept;
  for (size_t e = 0; e < kept.size(); ++e) {
    const int root = networks.root(c.edges[e][0]);
    if (slivers[root] > max_sliver_share * edges[root]) kept[e] = 0;
  }
  return kept != before;
}

struct FoundCreases {
  std::vector<char> marks;  // by edge
  bool had_bevels = false;  // that they do not follow, see has_grid_bevels()
};

/// All but hard edges. Pre-condition: the angle is not off.
FoundCreases find_creases(const Mat3X& points, const Adjacency& c, const std::vector<double>& length,
                          CreaseOptions options) {
  if (options.drops_noise && is_staircase(points, c, length)) return {std::vector<char>(c.edges.size(), 0)};
  FoundCreases found{FeatureSearch(points, c, length, options).find(true)};
  found.had_bevels =
      options.drops_noise && is_isosurface(points, c, length) && drop_bevels(points, c, found.marks);
  if (found.had_bevels) {
    options.angle = std::max(options.angle, sharper_than_bevels);
    const std::vector<char> sharp = FeatureSearch(points, c, length, options).find(false);
    for (size_t e = 0; e < sharp.size(); ++e) found.marks[e] = found.marks[e] || sharp[e];
  }
  return found;
}

/// Keeps these edges where they bend enough, also at the folds of zigzag strips.
void keep_hard_edges(const Mat3X& points, const Adjacency& c, double angle,
                     const std::vector<Edge>& hard_edges, std::vector<char>& kept) {
  if (hard_edges.empty()) return;
  const std::vector<double> angles = edge_angles(certain_face_normals(points, c), c);
  for (const auto& [a, b] : hard_edges)
    for (const int e : c.vertex_edges[a])
      if (c.other_end(e, a) == b && angles[e] > hysteresis * angle) kept[e] = 1;
}

}  // namespace

bool has_grid_bevels(const Mat3X& points, const Adjacency& adjacency,
                     const std::vector<double>& vertex_length, const CreaseOptions& options) {
  return options.angle < 180 && options.drops_noise && is_isosurface(points, adjacency, vertex_length) &&
         find_creases(points, adjacency, vertex_length, options).had_bevels;
}

std::vector<int> detect_tips(const Mat3X& points, const Adjacency& c,
                             const std::vector<double>& vertex_length, const CreaseOptions& o) {
  std::vector<int> tips;
  if (o.angle >= 180) return tips;
  for (int v = 0; v < c.vertex_count; ++v) {
    const auto is_resolved = [&](int e) {
      return (points.col(c.other_end(e, v)) - points.col(v)).norm() > resolved_length * vertex_length[v];
    };
    if (std::ranges::all_of(c.vertex_edges[v], is_resolved) && is_tip(points, c, v)) tips.push_back(v);
  }
  return tips;
}

std::vector<int> detect_creases(const Mat3X& points, const Adjacency& adjacency,
                                const std::vector<double>& vertex_length, const CreaseOptions& options,
                                const std::vector<Edge>& hard_edges) {
  if (options.angle >= 180) return {};
  std::vector<char> kept = find_creases(points, adjacency, vertex_length, options).marks;
  keep_hard_edges(points, adjacency, options.angle, hard_edges, kept);
  std::vector<int> creases;
  for (size_t e = 0; e < kept.size(); ++e)
    if (kept[e]) creases.push_back(static_cast<int>(e));
  return creases;
}

}  // namespace hooke
