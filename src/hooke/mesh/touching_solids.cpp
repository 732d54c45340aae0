#include "hooke/mesh/touching_solids.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <utility>

#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/disjoint_sets.h"
#include "hooke/mesh/extent.h"
#include "hooke/mesh/validation.h"

namespace hooke {
namespace {

bool is_of_touching_solids(ProblemKind kind) {
  return is_junction(kind) || kind == ProblemKind::duplicate_face ||
         kind == ProblemKind::inconsistent_orientation;
}

/// Of a part of a mesh in numbers of its own: none if it is not solids that touch.
std::optional<Sheets> separate(const Mat3X& points, const std::vector<Triangle>& triangles) {
  const auto is_wrong = [](const Problem& problem) { return !is_acceptable(problem.kind); };
  std::vector<Problem> problems = find_problems(points, triangles);
  std::erase_if(problems, [&](const Problem& problem) { return !is_wrong(problem); });
  if (problems.empty() ||
      !std::ranges::all_of(problems, [](const Problem& p) { return is_of_touching_solids(p.kind); }))
    return std::nullopt;
  Sheets sheets = make_sheets(points, triangles);
  if (!sheets.flipped_faces.empty() || !sheets.opened_edges.empty() || !sheets.guessed_edges.empty())
    return std::nullopt;
  const Mat3X apart = points(Eigen::all, sheets.source);
  if (std::ranges::any_of(find_problems(apart, sheets.triangles), is_wrong)) return std::nullopt;
  const Extent extent =
      measure_extent(apart, make_adjacency(static_cast<int>(apart.cols()), sheets.triangles));
  if (!extent.volume || !(*extent.volume > 0)) return std::nullopt;
  return sheets;
}

/// The faces of each part that hangs together over vertices, ascending.
std::vector<std::vector<int>> parts_of(const Mat3X& points, const std::vector<Triangle>& triangles) {
  DisjointSets sets(static_cast<std::size_t>(points.cols()));
  for (const auto& [a, b, c] : triangles) {
    sets.join({a, b});
    sets.join({a, c});
  }
  std::vector<int> number(points.cols(), -1);
  std::vector<std::vector<int>> parts;
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    int& part = number[sets.root(triangles[f][0])];
    if (part < 0) {
      part = static_cast<int>(parts.size());
      parts.emplace_back();
    }
    parts[part].push_back(static_cast<int>(f));
  }
  return parts;
}

}  // namespace

std::optional<Sheets> separate_touching_solids(const Mat3X& points, const std::vector<Triangle>& triangles) {
  constexpr std::size_t least_faces = 8;  // two tetrahedra
  Sheets all;
  all.triangles = triangles;
  for (int v = 0; v < points.cols(); ++v) all.source.push_back(v);
  std::vector<int> local(points.cols(), -1);
  bool found = false;
  for (const std::vector<int>& faces : parts_of(points, triangles)) {
    if (faces.size() < least_faces) continue;
    std::vector<int> vertices;
    std::vector<Triangle> of_part;
    for (const int f : faces) {
      Triangle& t = of_part.emplace_back(triangles[f]);
      for (int& v : t) {
        if (local[v] < 0) {
          local[v] = static_cast<int>(vertices.size());
          vertices.push_back(v);
        }
        v = local[v];
      }
    }
    for (const int v : vertices) local[v] = -1;
    const std::optional<Sheets> sheets = separate(points(Eigen::all, vertices), of_part);
    if (!sheets) continue;
    found = true;
    const auto old_edge = [&](const Edge& e) { return Edge{vertices[e[0]], vertices[e[1]]}; };
    std::ranges::transform(sheets->cut_edges, std::back_inserter(all.cut_edges), old_edge);
    for (const int v : sheets->split_vertices) all.split_vertices.push_back(vertices[v]);
    std::vector<int> id = vertices;
    for (std::size_t v = vertices.size(); v < sheets->source.size(); ++v) {
      id.push_back(static_cast<int>(all.source.size()));
      all.source.push_back(vertices[sheets->source[v]]);
    }
    for (std::size_t k = 0; k < faces.size(); ++k)
      for (std::size_t corner = 0; corner < 3; ++corner)
        all.triangles[faces[k]][corner] = id[sheets->triangles[k][corner]];
  }
  if (!found) return std::nullopt;
  return all;
}

std::vector<int> closed_bodies(const std::vector<Triangle>& triangles) {
  const auto is_proper = [](const Triangle& t) { return t[0] != t[1] && t[1] != t[2] && t[2] != t[0]; };
  std::vector<std::array<int, 3>> uses;  // of edges by faces: smaller vertex, larger vertex, face
  for (std::size_t f = 0; f < triangles.size(); ++f)
    for (std::size_t k = 0; k < 3 && is_proper(triangles[f]); ++k) {
      const auto [low, high] = std::minmax(triangles[f][k], triangles[f][(k + 1) % 3]);
      uses.push_back({low, high, static_cast<int>(f)});
    }
  std::ranges::sort(uses);
  DisjointSets sets(triangles.size());
  const auto for_each_edge = [&](const auto& visit) {
    for (std::size_t i = 0, next = 0; i < uses.size(); i = next) {
      while (next < uses.size() && uses[next][0] == uses[i][0] && uses[next][1] == uses[i][1]) ++next;
      visit(i, next - i);
    }
  };
  for_each_edge([&](std::size_t i, std::size_t count) {
    if (count == 2) sets.join({uses[i][2], uses[i + 1][2]});
  });
  std::vector<char> is_open(triangles.size(), 0);
  for_each_edge([&](std::size_t i, std::size_t count) {
    if (count == 1) is_open[sets.root(uses[i][2])] = 1;
  });
  std::vector<int> bodies;
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const int root = sets.root(static_cast<int>(f));
    bodies.push_back(is_open[root] || !is_proper(triangles[f]) ? -1 : root);
  }
  return bodies;
}

}  // namespace hooke
