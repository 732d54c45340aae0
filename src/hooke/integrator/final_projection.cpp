#include "hooke/integrator/final_projection.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "hooke/geometry/self_intersection.h"

namespace hooke {
namespace {

std::vector<int> put_back(const Guards& guards, const Placement& from, std::vector<int> offending,
                          Placement& to) {
  std::vector<char> is_back(from.drift.size(), 0);
  std::vector<int> all;
  while (!offending.empty()) {
    std::erase_if(offending, [&](int v) { return std::exchange(is_back[static_cast<size_t>(v)], 1); });
    for (int v : offending) {
      to.points.col(v) = from.points.col(v);
      to.normals.col(v) = from.normals.col(v);
      if (const int other = to.other_side_of(v); other >= 0) to.normals.col(other) = from.normals.col(other);
    }
    all.insert(all.end(), offending.begin(), offending.end());
    offending = guards.offenders_around(from, to, offending);
  }
  return all;
}

using FacePairs = std::vector<std::array<int, 2>>;

std::vector<int> corners_of(const FacePairs& pairs, const std::vector<Triangle>& faces) {
  std::vector<int> corners;
  for (const auto& pair : pairs)
    for (int f : pair)
      corners.insert(corners.end(), faces[static_cast<size_t>(f)].begin(),
                     faces[static_cast<size_t>(f)].end());
  return corners;
}

/// Marks the vertices of faces that cross and those within so many rings about them.
std::vector<char> about_crossings(const Placement& p, const Connectivity& c, int rings) {
  std::vector<char> marked(static_cast<size_t>(c.vertex_count), 0);
  for (int v : with_rings(c, corners_of(find_self_intersections(p.points, c.faces), c.faces), rings))
    marked[static_cast<size_t>(v)] = 1;
  return marked;
}

}  // namespace

std::vector<int> put_back_offenders(const Guards& guards, const Placement& from, Placement& to) {
  return put_back(guards, from, guards.offenders(from, to), to);
}

std::vector<int> put_back_offenders(const Guards& guards, const Placement& from,
                                    const std::vector<int>& moved, Placement& to) {
  return put_back(guards, from, guards.offenders_around(from, to, moved), to);
}

std::vector<int> put_back_crossings(const Guards& guards, const Connectivity& connectivity,
                                    const Placement& from, Placement& to) {
  constexpr int most_rounds = 8;
  constexpr int rings_along = 2;  // about what crossed before, within which it may go on to
  std::vector<int> all;
  std::optional<std::vector<char>> crossed;
  for (int round = 0; round < most_rounds; ++round) {
    FacePairs crossings = find_self_intersections(to.points, connectivity.faces);
    if (crossings.empty()) break;
    if (!crossed) crossed = about_crossings(from, connectivity, rings_along);
    const auto touches = [&](int f) {
      return std::ranges::any_of(connectivity.faces[static_cast<size_t>(f)],
                                 [&](int v) { return (*crossed)[static_cast<size_t>(v)] != 0; });
    };
    std::erase_if(crossings, [&](const auto& pair) { return touches(pair[0]) && touches(pair[1]); });
    std::vector<int> vertices = with_rings(connectivity, corners_of(crossings, connectivity.faces), round);
    std::erase_if(vertices, [&](int v) { return to.points.col(v) == from.points.col(v); });
    if (vertices.empty()) break;
    for (int v : put_back(guards, from, std::move(vertices), to)) {
      VertexPlace(from, v).write_to(to, v);
      all.push_back(v);
    }
  }
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

void settle(const Guards& guards, Retraction& retraction, const Placement& from, Placement& to) {
  to = from;
  retraction.settle(to);
  for (int v : put_back_offenders(guards, from, to)) VertexPlace(from, v).write_to(to, v);
}

void settle(const Guards& guards, Retraction& retraction, Placement& placement) {
  Placement settled;
  settle(guards, retraction, placement, settled);
  placement = std::move(settled);
}

}  // namespace hooke
