#include "hooke/springs/rest_ratios.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <numeric>
#include <utility>

#include "hooke/core/error.h"
#include "hooke/core/parallel.h"

namespace hooke {

namespace {

constexpr char not_the_faces[] = "polygons that are not the faces of the mesh";

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
  throw Error(not_the_faces);
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
    if (face + triangles > c.faces.size()) throw Error(not_the_faces);
    if (triangles == 2)
      all.push_back(quadrilateral_of(c.face_edges[in_memory[face]], c.face_edges[in_memory[face + 1]]));
    face += triangles;
  }
  if (face != c.faces.size()) throw Error(not_the_faces);
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

/// Pairs of sides of quadrilaterals that go on in line across a vertex: of its four sides those that share no
/// quadrilateral, of three at a boundary the two along it.
std::vector<Edge> pairs_in_line(const std::vector<Quadrilateral>& quadrilaterals, const Adjacency& c) {
  std::vector<int> quadrilateral_of_face(c.faces.size(), -1);
  std::vector<char> is_side(c.edges.size(), 0);
  for (std::size_t q = 0; q < quadrilaterals.size(); ++q) {
    for (int f : c.edge_faces[quadrilaterals[q].diagonal]) quadrilateral_of_face[f] = static_cast<int>(q);
    for (const Edge& side : quadrilaterals[q].sides)
      for (int e : side) is_side[e] = 1;
  }
  const auto share_quadrilateral = [&](int e, int other) {
    for (int f : c.edge_faces[e])
      for (int g : c.edge_faces[other])
        if (f >= 0 && g >= 0 && quadrilateral_of_face[f] >= 0 &&
            quadrilateral_of_face[f] == quadrilateral_of_face[g])
          return true;
    return false;
  };
  std::vector<Edge> pairs;
  std::vector<int> sides;
  for (int v = 0; v < c.vertex_count; ++v) {
    sides.clear();
    for (int e : c.vertex_edges[v])
      if (is_side[e]) sides.push_back(e);
    if (sides.size() != 3 && sides.size() != 4) continue;
    const auto can_go_on = [&](int e) { return sides.size() == 4 || c.is_boundary_edge(e); };
    for (std::size_t i = 0; i < sides.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (can_go_on(sides[i]) && can_go_on(sides[j]) && !share_quadrilateral(sides[i], sides[j]))
          pairs.push_back({sides[i], sides[j]});
  }
  return pairs;
}

/// Weighted means of the values around each edge, over about the square root of `rounds` pairs away. The
/// values of edges in fewer than `least_count` pairs stay.
std::vector<double> smoothed(const std::vector<Edge>& pairs, std::vector<double> values, int least_count) {
  constexpr int rounds = 24;
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
      if (count[e] >= least_count) values[e] = (values[e] + sum[e] / count[e]) / 2;
  }
  return values;
}

/// Evens the lengths across strips, whose ends stay, so that linear growth stays too. What that changes by
/// the same amount in a whole line of sides, as at the rim of a plate, is meant, and is taken back.
std::vector<double> evened(const std::vector<Quadrilateral>& quadrilaterals, const Adjacency& c,
                           const std::vector<double>& lengths) {
  std::vector<double> even = smoothed(pairs_of_edges(quadrilaterals, c), lengths, 2);
  const std::vector<Edge> lines = pairs_in_line(quadrilaterals, c);
  std::vector<double> change(even.size(), 0);
  for (const Edge& pair : lines)
    for (int e : pair) change[e] = even[e] - lengths[e];
  change = smoothed(lines, change, 1);
  for (std::size_t e = 0; e < even.size(); ++e) even[e] -= change[e];
  return even;
}

}  // namespace

std::vector<double> rest_ratios(const IntLists& polygons, const MemoryOrder& memory_order,
                                const Mat3X& points, const TargetLengths& targets) {
  const Adjacency& c = *memory_order.adjacency;
  const std::vector<Quadrilateral> quadrilaterals = quadrilaterals_of(polygons, memory_order);
  std::vector<double> rest(c.edges.size());  // lengths, in no unit before they are scaled
  for (std::size_t e = 0; e < rest.size(); ++e) {
    const auto& [v, w] = c.edges[e];
    rest[e] = targets.edge.is_varying() ? 1 : (points.col(v) - points.col(w)).norm();
  }
  rest = evened(quadrilaterals, c, rest);
  constexpr double least_share = 1e-4;  // of the mean, for quadrilaterals without length
  const double mean = std::accumulate(rest.begin(), rest.end(), 0.) / static_cast<double>(rest.size());
  for (double& length : rest) length = std::max(length, least_share * mean);
  constexpr double least_taper = .1;  // of opposite sides, for sides without length, as at poles
  for (const Quadrilateral& q : quadrilaterals)
    for (const auto& [a, b] : q.sides) {
      rest[a] = std::max(rest[a], least_taper * rest[b]);
      rest[b] = std::max(rest[b], least_taper * rest[a]);
    }
  for (const auto& [sides, diagonal] : quadrilaterals)
    rest[diagonal] = std::hypot(std::midpoint(rest[sides[0][0]], rest[sides[0][1]]),
                                std::midpoint(rest[sides[1][0]], rest[sides[1][1]]));
  double area = 0;
  for (const auto& [i, j, k] : c.face_edges) area += area_of_sides(rest[i], rest[j], rest[k]);
  const double scale = natural_length(area, c.faces.size());
  for (double& length : rest) length /= scale;
  return rest;
}

std::size_t count_with_corners(const IntLists& polygons, std::size_t corners) {
  std::size_t count = 0;
  for (int p = 0; p + 1 < std::ssize(polygons.first); ++p) count += polygons[p].size() == corners;
  return count;
}

TargetLengths at_rest_ratios(const Adjacency& c, const TargetLengths& targets,
                             const std::vector<double>& ratios) {
  constexpr std::size_t faces_per_task = 4096;
  std::vector<double> edge(c.edges.size()), face(c.faces.size());
  for (std::size_t e = 0; e < edge.size(); ++e) edge[e] = ratios[e] * targets.edge[e];
  parallel_for(face.size(), faces_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const auto& [i, j, k] = c.face_edges[f];
      const double a = edge[i], b = edge[j], d = edge[k];
      constexpr double least_share = 1e-3;  // of the mean, for edges that make no triangle
      face[f] = std::max(4 / std::sqrt(3.) * area_of_sides(a, b, d) / std::max({a, b, d}),
                         least_share * ((a + b + d) / 3));
    }
  });
  return {std::move(edge), std::move(face)};
}

double area_of_sides(double a, double b, double c) {
  const double half = (a + b + c) / 2;
  return std::sqrt(std::max(0., half * (half - a) * (half - b) * (half - c)));
}

}  // namespace hooke
