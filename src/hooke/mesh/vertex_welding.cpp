#include "hooke/mesh/vertex_welding.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <unordered_map>

#include "hooke/geometry/aabb_tree.h"
#include "hooke/geometry/triangle.h"

namespace hooke {
namespace {

using Cell = std::array<double, 3>;  // whole numbers, or the point itself where cells have no size

struct CellHash {
  size_t operator()(const Cell& cell) const {
    std::uint64_t hash = 0;
    for (const double x : cell) {
      hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 29;
    }
    return hash;
  }
};

// The vertices that are merged with none so far, by the cells of a grid.
class Grid {
 public:
  Grid(const Mat3X& points, double size) : points_(points), size_(size), next_(points.cols(), -1) {}

  void add(int vertex) {
    const auto [head, fresh] = heads_.try_emplace(cell_of(vertex), vertex);
    if (fresh) return;
    next_[vertex] = head->second;
    head->second = vertex;
  }

  /// Calls use(vertex) for all in the cells at the vertex and beside it.
  template <typename Use>
  void for_each_near(int vertex, const Use& use) const {
    const Cell cell = cell_of(vertex);
    if (size_ == 0) return for_each_in(cell, use);
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k) for_each_in({cell[0] + k, cell[1] + j, cell[2] + i}, use);
  }

 private:
  Cell cell_of(int vertex) const {
    Cell cell;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double x = points_(k, vertex) + 0.;  // no -0
      cell[k] = size_ == 0 ? x : std::floor(x / size_) + 0.;
    }
    return cell;
  }

  template <typename Use>
  void for_each_in(const Cell& cell, const Use& use) const {
    const auto head = heads_.find(cell);
    if (head == heads_.end()) return;
    for (int v = head->second; v >= 0; v = next_[v]) use(v);
  }

  const Mat3X& points_;
  double size_;
  std::unordered_map<Cell, int, CellHash> heads_;
  std::vector<int> next_;  // in the same cell
};

}  // namespace

std::vector<int> weld_vertices(const Mat3X& points, const std::vector<double>& reach) {
  std::vector<int> merged(reach.size());
  Grid grid(points, reach.empty() ? 0 : std::max(0., std::ranges::max(reach)));
  for (int v = 0; v < static_cast<int>(reach.size()); ++v) {
    merged[v] = v;
    const double own = reach[v];
    if (own < 0) continue;
    int closest = v;
    double least = std::numeric_limits<double>::infinity();
    grid.for_each_near(v, [&](int other) {
      const double distance = (points.col(v) - points.col(other)).norm();
      if (distance > std::min(own, reach[other])) return;
      if (distance < least || (distance == least && other < closest)) {
        least = distance;
        closest = other;
      }
    });
    merged[v] = closest;
    if (closest == v) grid.add(v);
  }
  return merged;
}

std::vector<double> reach_of_edges(const Mat3X& points, const std::vector<Edge>& edges) {
  std::vector<double> reach(points.cols(), -1);
  for (const auto& [a, b] : edges) {
    const double length = welding_share * (points.col(a) - points.col(b)).norm();
    for (const int v : {a, b}) {
      double& own = reach[v];
      own = own < 0 ? length : std::min(own, length);
    }
  }
  return reach;
}

std::vector<double> reach_of_boundary(const Mat3X& points, const std::vector<Triangle>& triangles) {
  std::vector<Edge> edges, boundary;
  edges.reserve(3 * triangles.size());
  for (const Triangle& t : triangles)
    for (size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(t[k], t[(k + 1) % 3]);
      edges.push_back({low, high});
    }
  std::ranges::sort(edges);
  for (auto edge = edges.begin(), last = edge; edge != edges.end(); edge = last) {
    last = std::find_if(edge, edges.end(), [&](const Edge& other) { return other != *edge; });
    if (last - edge == 1 && (*edge)[0] != (*edge)[1]) boundary.push_back(*edge);
  }
  return reach_of_edges(points, boundary);
}

std::vector<int> vertices_at_cracks(const Mat3X& points, const Adjacency& c) {
  constexpr double crack_share = .01;  // of the length of the edge
  constexpr double opposed = -.5;      // cosine
  std::vector<Triangle> segments;
  std::vector<int> boundary, edges;
  Mat3X outward = Mat3X::Zero(3, c.vertex_count);  // from the surface, at its boundary vertices
  std::vector<Vec3> outward_of_edge;
  double longest = 0;
  for (std::size_t e = 0; e < c.edges.size(); ++e) {
    if (!c.is_boundary_edge(static_cast<int>(e))) continue;
    const auto& [a, b] = c.edges[e];
    const Vec3 along = points.col(b) - points.col(a);
    boundary.push_back(a);
    segments.push_back({a, b, b});
    edges.push_back(static_cast<int>(e));
    outward_of_edge.push_back(
        along.cross(doubled_area_vector(points, c.faces[c.edge_faces[e][0]])).stableNormalized());
    for (const int v : {a, b}) outward.col(v) += outward_of_edge.back();
    longest = std::max(longest, along.norm());
  }
  std::ranges::sort(boundary);
  const AabbTree tree(points, segments);
  ClosestPoint within;
  within.squared_distance = std::pow(crack_share * longest, 2);
  std::vector<int> found;
  for (const int v : boundary) {
    const Vec3 x = points.col(v), out = outward.col(v).stableNormalized();
    const auto is_across = [&](int s) {
      const Vec3 a = points.col(segments[s][0]), b = points.col(segments[s][1]);
      const double length = (a - b).norm(), merged = welding_share * length;
      const Triangle& face = c.faces[c.edge_faces[edges[s]][0]];
      const auto lies_beyond = [&](int w) { return out.dot(points.col(w) - x) > crack_share * length; };
      return out.dot(outward_of_edge[s]) < opposed && std::ranges::any_of(face, lies_beyond) &&
             (x - a).norm() > merged && (x - b).norm() > merged &&
             distance_to_segment(x, a, b) <= crack_share * length;
    };
    if (tree.closest(x, is_across, within).face >= 0) found.push_back(v);
  }
  return found;
}

std::vector<Edge> coincident_boundary_pairs(const Mat3X& points, const Adjacency& c) {
  std::vector<int> boundary;
  for (std::size_t e = 0; e < c.edges.size(); ++e)
    if (c.is_boundary_edge(static_cast<int>(e))) boundary.push_back(c.edges[e][0]);
  const auto coordinates = [&](int v) { return std::tuple(points(0, v), points(1, v), points(2, v)); };
  std::ranges::sort(boundary, {}, coordinates);
  std::vector<Edge> pairs;
  for (std::size_t i = 1; i < boundary.size(); ++i)
    if (coordinates(boundary[i - 1]) == coordinates(boundary[i]))
      pairs.push_back({boundary[i - 1], boundary[i]});
  return pairs;
}

}  // namespace hooke
