#include "hooke/springs/target_lengths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "hooke/core/parallel.h"
#include "hooke/mesh/disjoint_sets.h"
#include "hooke/mesh/extent.h"
#include "hooke/mesh/junctions.h"
#include "hooke/mesh/vertex_welding.h"

namespace hooke {
namespace {

constexpr size_t length_block = 4096;

double face_area(const Mat3X& points, const Triangle& t) {
  const Vec3 a = points.col(t[0]);
  return .5 * (points.col(t[1]) - a).cross(points.col(t[2]) - a).norm();
}

/// The number of the part of each vertex, -1 without faces. Shells whose boundaries coincide are one part: a
/// surface that was cut open.
std::vector<int> label_parts(const Mat3X& points, const Adjacency& c, const std::vector<int>& joined) {
  std::vector<int> shells = label_shells(c, joined);
  DisjointSets parts(static_cast<std::size_t>(1 + std::max(0, std::ranges::max(shells))));
  for (const auto& [v, w] : coincident_boundary_pairs(points, c)) parts.join({shells[v], shells[w]});
  std::vector<int> number(shells.size(), -1);
  int count = 0;
  for (int& shell : shells) {
    if (shell < 0) continue;
    int& of_part = number[parts.root(shell)];
    if (of_part < 0) of_part = count++;
    shell = of_part;
  }
  return shells;
}

double mean_of_three(double a, double b, double c) {
  return (a + b + c) / 3;
}

}  // namespace

double natural_length(double area, std::size_t face_count) {
  return std::sqrt(4 * area / (std::sqrt(3.) * static_cast<double>(face_count)));
}

UniformVector natural_lengths_of_parts(const Mat3X& points, const Adjacency& c,
                                       const std::vector<int>& joined) {
  constexpr double alike = .05;      // relative difference
  constexpr double of_edges = .5;    // least length, in the part's mean edges: slivers have long ones
  constexpr double shortest = 1e-3;  // of the whole
  const double natural = natural_length(total_area(points, c.faces), c.faces.size());
  const std::vector<int> parts = label_parts(points, c, joined);
  const auto count = static_cast<std::size_t>(1 + std::max(0, std::ranges::max(parts)));
  if (count == 1) return {parts.size(), natural};
  struct Part {
    double area = 0, perimeters = 0;
    std::size_t faces = 0;
  };
  std::vector<Part> sums(count);
  for (const Triangle& t : c.faces) {
    Part& part = sums[parts[t[0]]];
    part.area += face_area(points, t);
    for (std::size_t k = 0; k < 3; ++k)
      part.perimeters += (points.col(t[k]) - points.col(t[(k + 1) % 3])).norm();
    ++part.faces;
  }
  std::vector<double> lengths;
  for (const Part& part : sums)
    lengths.push_back(std::max({natural_length(part.area, part.faces), shortest * natural,
                                of_edges * part.perimeters / static_cast<double>(3 * part.faces)}));
  if (std::ranges::all_of(lengths, [&](double l) { return std::abs(l - natural) <= alike * natural; }))
    return {parts.size(), natural};
  std::vector<double> of_vertices;
  for (int part : parts) of_vertices.push_back(part < 0 ? natural : lengths[part]);
  return of_vertices;
}

double covering_length(const Mat3X& points, const Adjacency& c, const TargetLengths& targets) {
  if (!targets.face.is_varying()) return targets.face[0];
  const auto sum = [&](const auto& weight) {
    return parallel_sum(c.faces.size(), length_block, [&](size_t begin, size_t end) {
      double part = 0;
      for (size_t f = begin; f < end; ++f) part += weight(f) * face_area(points, c.faces[f]);
      return part;
    });
  };
  return std::sqrt(sum([](size_t) { return 1.; }) /
                   sum([&](size_t f) { return 1 / (targets.face[f] * targets.face[f]); }));
}

double mean_length(const Mat3X& points, const Adjacency& c, const TargetLengths& targets) {
  const double first = targets.edge[0];
  if (!targets.edge.is_varying()) return first;
  const auto sum = [&](const auto& value) {
    return parallel_sum(c.faces.size(), length_block, [&](size_t begin, size_t end) {
      double part = 0;
      for (size_t f = begin; f < end; ++f) {
        double of_edges = 0;
        for (int e : c.face_edges[f]) of_edges += value(targets.edge[e]);
        part += of_edges * face_area(points, c.faces[f]);
      }
      return part;
    });
  };
  return first +
         sum([&](double l) { return (l - first) / (l * l); }) / sum([](double l) { return 1 / (l * l); });
}

TargetLengths from_edge_lengths(const Adjacency& c, std::vector<double> edge) {
  std::vector<double> face(c.faces.size());
  parallel_for(face.size(), length_block, [&](size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) {
      const auto& [a, b, d] = c.face_edges[f];
      face[f] = mean_of_three(edge[a], edge[b], edge[d]);
    }
  });
  return {std::move(edge), std::move(face)};
}

double least_rest_angle(const Adjacency& c, const TargetLengths& targets) {
  double greatest_cosine = .5;
  for (const auto& [i, j, k] : c.face_edges) {
    std::array<double, 3> sides{targets.edge[i], targets.edge[j], targets.edge[k]};
    std::ranges::sort(sides);
    const auto& [a, b, d] = sides;
    if (a + b > d) greatest_cosine = std::max(greatest_cosine, (b * b + d * d - a * a) / (2 * b * d));
  }
  return std::acos(std::min(1., greatest_cosine)) * 180 / std::numbers::pi;
}

bool are_even(const Adjacency& c, const TargetLengths& targets) {
  return !targets.edge.is_varying() || std::ranges::all_of(c.face_edges, [&](const auto& edges) {
    return std::ranges::all_of(edges, [&](int e) { return targets.edge[e] == targets.edge[edges[0]]; });
  });
}

TargetLengths spread_target_lengths(const Adjacency& c, const std::vector<double>& vertex_length) {
  if (!c.faces.empty() && UniformVector::are_equal(vertex_length)) {
    const double length = vertex_length[0];
    return {UniformVector(c.edges.size(), length),
            UniformVector(c.faces.size(), mean_of_three(length, length, length))};
  }
  std::vector<double> edge(c.edges.size());
  parallel_for(edge.size(), length_block, [&](size_t begin, size_t end) {
    for (size_t e = begin; e < end; ++e) {
      const auto& [a, b] = c.edges[e];
      edge[e] = .5 * (vertex_length[a] + vertex_length[b]);
    }
  });
  return from_edge_lengths(c, std::move(edge));
}

}  // namespace hooke
