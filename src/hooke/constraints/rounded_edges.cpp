#include "hooke/constraints/rounded_edges.h"

#include <algorithm>
#include <numbers>
#include <queue>
#include <tuple>

#include "hooke/geometry/triangle.h"
#include "hooke/mesh/disjoint_sets.h"
#include "hooke/mesh/normals.h"

namespace hooke {
namespace {

constexpr double least_radius = .7;  // in target lengths: tighter is no part of a side
constexpr double least_width = .5;   // of a side, in target lengths
constexpr double wider = 3;          // or over the parts beside it
constexpr double max_width = 1;      // from a side to the middle of a rounded edge, in target lengths
constexpr double least_length = 1;   // of a line, in target lengths

/// Shares out the faces among the sides.
class RoundedEdges {
 public:
  RoundedEdges(const Mat3X& points, const Adjacency& c, const std::vector<double>& length,
               const std::vector<char>& creases)
      : points_(points),
        c_(c),
        length_(length),
        creases_(creases),
        normals_(certain_face_normals(points, c)) {
    find_sides();
    share_out();
    straighten();
  }

  std::vector<Edge> middles(double sharp_angle) const {
    std::vector<Edge> lines;
    std::vector<int> edges;
    DisjointSets sets(static_cast<size_t>(c_.vertex_count));
    for (int e = 0; e < std::ssize(c_.edges); ++e) {
      if (is_barrier(e)) continue;
      const auto& [f, g] = c_.edge_faces[e];
      if (side_[f] < 0 || side_[g] < 0 || side_[f] == side_[g]) continue;
      if (angle_between(normals_.col(source_[f]), normals_.col(source_[g])) <= sharp_angle) continue;
      edges.push_back(e);
      sets.join(c_.edges[e]);
    }
    std::vector<double> total(c_.vertex_count, 0);
    for (int e : edges) total[sets.root(c_.edges[e][0])] += length(e) / target(e);
    for (int e : edges)
      if (total[sets.root(c_.edges[e][0])] >= least_length) lines.push_back(c_.edges[e]);
    return lines;
  }

 private:
  bool is_barrier(int e) const { return c_.is_boundary_edge(e) || creases_[e] != 0; }

  double length(int e) const {
    const auto& [a, b] = c_.edges[e];
    return (points_.col(a) - points_.col(b)).norm();
  }

  double target(int e) const { return length_[e]; }

  /// Does the surface bend at the edge with a radius below the target length?
  bool is_tight(int e) const {
    const auto& [f, g] = c_.edge_faces[e];
    const double angle = angle_between(normals_.col(f), normals_.col(g)) * std::numbers::pi / 180;
    const double height = std::min(doubled_area_vector(points_, c_.faces[f]).norm(),
                                   doubled_area_vector(points_, c_.faces[g]).norm()) /
                          length(e);
    return height < least_radius * target(e) * angle;
  }

  void find_sides() {
    DisjointSets parts(c_.faces.size());
    std::vector<char> divides(c_.edges.size(), 0);
    for (int e = 0; e < std::ssize(c_.edges); ++e) {
      divides[e] = is_barrier(e) || is_tight(e);
      if (!divides[e]) parts.join(c_.edge_faces[e]);
    }
    std::vector<double> areas(c_.faces.size(), 0), borders(c_.faces.size(), 0);
    for (size_t f = 0; f < c_.faces.size(); ++f)
      areas[parts.root(static_cast<int>(f))] += .5 * doubled_area_vector(points_, c_.faces[f]).norm();
    for (int e = 0; e < std::ssize(c_.edges); ++e) {
      if (!divides[e]) continue;
      const auto& [f, g] = c_.edge_faces[e];
      borders[parts.root(f)] += length(e) * target(e);
      if (g >= 0 && parts.root(f) != parts.root(g)) borders[parts.root(g)] += length(e) * target(e);
    }
    std::vector<double> widths(c_.faces.size(), 0), beside(c_.faces.size(), 0), targets(c_.faces.size(), 0);
    for (size_t f = 0; f < c_.faces.size(); ++f)
      if (borders[f] > 0) widths[f] = 2 * areas[f] / borders[f];
    for (int e = 0; e < std::ssize(c_.edges); ++e) {
      if (!divides[e] || is_barrier(e)) continue;
      const int f = parts.root(c_.edge_faces[e][0]), g = parts.root(c_.edge_faces[e][1]);
      if (f == g) continue;
      beside[f] = std::max(beside[f], widths[g]);
      beside[g] = std::max(beside[g], widths[f]);
    }
    side_.assign(c_.faces.size(), -1);
    source_.assign(c_.faces.size(), -1);
    for (size_t f = 0; f < c_.faces.size(); ++f) {
      const int part = parts.root(static_cast<int>(f));
      if (widths[part] < least_width && (beside[part] == 0 || widths[part] < wider * beside[part])) continue;
      side_[f] = part;
      source_[f] = static_cast<int>(f);
    }
  }

  struct Step {
    double angle;
    int face, from, edge;  // edge: where the front left the side
    bool operator>(const Step& other) const {
      return std::tie(angle, face, from) > std::tie(other.angle, other.face, other.from);
    }
  };

  void share_out() {
    std::priority_queue<Step, std::vector<Step>, std::greater<>> front;
    const auto advance = [&](int face, int left_at) {
      for (int e : c_.face_edges[face]) {
        if (is_barrier(e)) continue;
        const int next = c_.edge_faces[e][0] == face ? c_.edge_faces[e][1] : c_.edge_faces[e][0];
        if (side_[next] >= 0) continue;
        const int start = left_at < 0 ? e : left_at;
        if (left_at >= 0 && distance(start, e) > max_width * target(start)) continue;
        front.push({angle_between(normals_.col(source_[face]), normals_.col(next)), next, face, start});
      }
    };
    for (int f = 0; f < std::ssize(c_.faces); ++f)
      if (side_[f] >= 0) advance(f, -1);
    while (!front.empty()) {
      const Step step = front.top();
      front.pop();
      if (side_[step.face] >= 0) continue;
      side_[step.face] = side_[step.from];
      source_[step.face] = source_[step.from];
      advance(step.face, step.edge);
    }
  }

  /// Of the middle of an edge from the line through another.
  double distance(int line, int e) const {
    const auto& [a, b] = c_.edges[line];
    const auto& [v, w] = c_.edges[e];
    const Vec3 along = (points_.col(b) - points_.col(a)).normalized();
    return along.cross(.5 * (points_.col(v) + points_.col(w)) - points_.col(a)).norm();
  }

  /// Lets faces go to the side that they share two edges with, and those between two go to the first.
  void straighten() {
    constexpr int max_sweeps = 4;
    constexpr double alike = 1, hardly_farther = 25;  // degrees
    for (int sweep = 0; sweep < max_sweeps; ++sweep)
      for (int f = 0; f < std::ssize(c_.faces); ++f) {
        if (side_[f] < 0 || source_[f] == f) continue;
        int neighbour = -1;
        bool shares_two = false;
        for (int e : c_.face_edges[f]) {
          if (is_barrier(e)) continue;
          const int g = c_.edge_faces[e][0] == f ? c_.edge_faces[e][1] : c_.edge_faces[e][0];
          if (side_[g] < 0 || side_[g] == side_[f]) continue;
          shares_two = shares_two || (neighbour >= 0 && side_[neighbour] == side_[g]);
          if (neighbour < 0 || side_[g] < side_[neighbour]) neighbour = g;
        }
        if (neighbour < 0) continue;
        const double more = angle_between(normals_.col(source_[neighbour]), normals_.col(f)) -
                            angle_between(normals_.col(source_[f]), normals_.col(f));
        if ((shares_two && more < hardly_farther) || (more < alike && side_[neighbour] < side_[f])) {
          side_[f] = side_[neighbour];
          source_[f] = source_[neighbour];
        }
      }
  }

  const Mat3X& points_;
  const Adjacency& c_;
  const std::vector<double>& length_;
  const std::vector<char>& creases_;
  const Mat3X normals_;
  std::vector<int> side_, source_;  // by face: its side, -1 for none, and the face of the side by its angle
};

}  // namespace

std::vector<Edge> middles_of_rounded_edges(const Mat3X& points, const Adjacency& adjacency,
                                           const std::vector<double>& edge_length, double sharp_angle,
                                           const std::vector<char>& creases) {
  return RoundedEdges(points, adjacency, edge_length, creases).middles(sharp_angle);
}

}  // namespace hooke
