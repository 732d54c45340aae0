#include "hooke/springs/polygon_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <numeric>
#include <utility>

#include "hooke/core/error.h"

namespace hooke {

namespace {

/// A quadrilateral by its edges: two pairs of opposite sides, and the diagonal.
struct Quadrilateral {
  std::array<Edge, 2> sides;
  int diagonal = 0;
};

/// Of two triangles.
Quadrilateral quadrilateral_of(const Triangle& edges, const Triangle& others) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (edges[i] == others[j])
        return {{{{edges[(i + 1) % 3], others[(j + 1) % 3]}, {edges[(i + 2) % 3], others[(j + 2) % 3]}}},
                edges[i]};
  throw Error("polygons that are not the faces of the mesh");
}

std::vector<Quadrilateral> quadrilaterals_of(const IntLists& polygons, const MemoryOrder& memory_order) {
  const Adjacency& c = *memory_order.adjacency;
  std::vector<int> in_memory(c.faces.size());
  for (std::size_t f = 0; f < in_memory.size(); ++f)
    in_memory[memory_order.order.old_face[f]] = static_cast<int>(f);
  std::vector<Quadrilateral> all;
  std::size_t face = 0;
  for (int p = 0; p + 1 < std::ssize(polygons.first); ++p) {
    const std::size_t triangles = polygons[p].size() - 2;
    if (face + triangles > c.faces.size()) throw Error("polygons that are not the faces of the mesh");
    if (triangles == 2)
      all.push_back(quadrilateral_of(c.face_edges[in_memory[face]], c.face_edges[in_memory[face + 1]]));
    face += triangles;
  }
  if (face != c.faces.size()) throw Error("polygons that are not the faces of the mesh");
  return all;
}

/// Pairs of edges that are to be as long as each other: opposite sides of quadrilaterals, and the edges of
/// other faces that are not sides of those.
std::vector<Edge> pairs_of_edges(const std::vector<Quadrilateral>& quadrilaterals, const Adjacency& c) {
  std::vector<Edge> pairs;
  std::vector<char> is_of_quadrilateral(c.edges.size(), 0);
  for (const Quadrilateral& q : quadrilaterals) {
    is_of_quadrilateral[q.diagonal] = 1;
    for (const Edge& side : q.sides) {
      pairs.push_back(side);
      for (int e : side) is_of_quadrilateral[e] = 1;
    }
  }
  for (const Triangle& edges : c.face_edges)
    for (int k = 0; k < 3; ++k) {
      const Edge pair{edges[k], edges[(k + 1) % 3]};
      if (!is_of_quadrilateral[pair[0]] && !is_of_quadrilateral[pair[1]]) pairs.push_back(pair);
    }
  return pairs;
}

/// Weighted means of the values around each edge, over about the square root of `rounds` pairs away. Those
/// that stand in one pair, at the ends of strips, stay as they are, so that linear growth stays too.
void smooth(const std::vector<Edge>& pairs, std::vector<double>& values) {
  constexpr int rounds = 12;
  std::vector<int> count(values.size(), 0);
  for (const auto& [a, b] : pairs) {
    ++count[a];
    ++count[b];
  }
  std::vector<double> sum(values.size());
  for (int round = 0; round < rounds; ++round) {
    std::ranges::fill(sum, 0);
    for (const auto& [a, b] : pairs) {
      sum[a] += values[b];
      sum[b] += values[a];
    }
    for (std::size_t e = 0; e < values.size(); ++e)
      if (count[e] > 1) values[e] = (values[e] + sum[e] / count[e]) / 2;
  }
}

}  // namespace

std::vector<double> rest_ratios(const IntLists& polygons, const MemoryOrder& memory_order,
                                const Mat3X& points, const TargetLengths& targets) {
  const Adjacency& c = *memory_order.adjacency;
  const std::vector<Quadrilateral> quadrilaterals = quadrilaterals_of(polygons, memory_order);
  std::vector<double> ratios(c.edges.size());
  for (std::size_t e = 0; e < ratios.size(); ++e) {
    const auto& [v, w] = c.edges[e];
    ratios[e] = (points.col(v) - points.col(w)).norm() / targets.edge[e];
  }
  constexpr double least_share = .01;  // of the mean, for edges without length
  const double mean = std::accumulate(ratios.begin(), ratios.end(), 0.) / static_cast<double>(ratios.size());
  for (double& ratio : ratios) ratio = std::max(ratio, least_share * mean);
  smooth(pairs_of_edges(quadrilaterals, c), ratios);
  for (const auto& [sides, diagonal] : quadrilaterals)
    ratios[diagonal] = std::hypot(std::midpoint(ratios[sides[0][0]], ratios[sides[0][1]]),
                                  std::midpoint(ratios[sides[1][0]], ratios[sides[1][1]]));
  double area = 0;
  for (const auto& [i, j, k] : c.face_edges) area += area_of_sides(ratios[i], ratios[j], ratios[k]);
  const double scale = natural_length(area, c.faces.size());
  for (double& ratio : ratios) ratio /= scale;
  return ratios;
}

std::size_t count_quadrilaterals(const IntLists& polygons) {
  std::size_t count = 0;
  for (int p = 0; p + 1 < std::ssize(polygons.first); ++p) count += polygons[p].size() == 4;
  return count;
}

}  // namespace hooke
