#include "hooke/integrator/final_projection.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "hooke/constraints/junction_curves.h"
#include "hooke/core/lists.h"
#include "hooke/core/stopwatch.h"
#include "hooke/filter/retraction.h"
#include "hooke/geometry/self_intersection.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/adjacency.h"

namespace hooke {
namespace {

constexpr double slack = .05;  // two fields of one surface differ slightly without a fold

constexpr double area_ratio = .01;

/// Relative margin of the cotangent limit of the steps, so that the projection need not go below the minimum
/// angle.
constexpr double cotangent_reserve = 3e-3;

void add_none(std::vector<int>& /*vertices*/) {}

/// `add_copies` adds the vertices that must be reverted together with some.
template <typename AddCopies>
std::vector<int> revert(const Guards& guards, const SurfacePositions& from, std::vector<int> offending,
                        SurfacePositions& to, const AddCopies& add_copies) {
  std::vector<char> is_back(from.drift.size(), 0);
  std::vector<int> all;
  while (!offending.empty()) {
    add_copies(offending);
    std::erase_if(offending, [&](int v) { return std::exchange(is_back[v], 1); });
    for (int v : offending) {
      to.points.col(v) = from.points.col(v);
      to.normals.col(v) = from.normals.col(v);
      if (const int other = to.other_wedge_of(v); other >= 0) to.normals.col(other) = from.normals.col(other);
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
    for (int f : pair) corners.insert(corners.end(), faces[f].begin(), faces[f].end());
  return corners;
}

/// Marks the vertices of intersecting faces and of `rings` rings around them.
std::vector<char> mark_around_crossings(const SurfacePositions& p, const Adjacency& c, int rings) {
  std::vector<char> marked(c.vertex_count, 0);
  for (int v : with_rings(c, corners_of(find_self_intersections(p.points, c.faces), c.faces), rings))
    marked[v] = 1;
  return marked;
}

}  // namespace

std::vector<int> revert_offenders(const Guards& guards, const SurfacePositions& from, SurfacePositions& to) {
  return revert(guards, from, guards.offenders(from, to), to, add_none);
}

std::vector<int> revert_offenders(const Guards& guards, const SurfacePositions& from,
                                  const std::vector<int>& moved, SurfacePositions& to) {
  return revert(guards, from, guards.offenders_around(from, to, moved), to, add_none);
}

std::vector<int> revert_crossings(const Guards& guards, const Adjacency& adjacency,
                                  const Constraints& constraints, const SurfacePositions& from,
                                  SurfacePositions& to) {
  constexpr int max_rounds = 8;
  constexpr int rings_along = 2;  // rings around an intersection of `from` within which it may go on
  std::vector<int> all;
  const IntLists copies = copies_of_junctions(constraints);
  const auto add_copies = [&](std::vector<int>& vertices) {
    add_sliding_copies(constraints, copies, vertices);
  };
  std::optional<std::vector<char>> crossed;
  for (int round = 0; round < max_rounds; ++round) {
    FacePairs crossings = find_self_intersections(to.points, adjacency.faces);
    if (crossings.empty()) break;
    if (!crossed) crossed = mark_around_crossings(from, adjacency, rings_along);
    const auto touches = [&](int f) {
      return std::ranges::any_of(adjacency.faces[f], [&](int v) { return (*crossed)[v] != 0; });
    };
    std::erase_if(crossings, [&](const auto& pair) { return touches(pair[0]) && touches(pair[1]); });
    std::vector<int> vertices = with_rings(adjacency, corners_of(crossings, adjacency.faces), round);
    std::erase_if(vertices, [&](int v) { return to.points.col(v) == from.points.col(v); });
    if (vertices.empty()) break;
    for (int v : revert(guards, from, std::move(vertices), to, add_copies)) {
      SurfacePosition(from, v).write_to(to, v);
      all.push_back(v);
    }
  }
  sort_unique(all);
  return all;
}

void project_drifted(const Guards& guards, Retraction& retraction, const SurfacePositions& from,
                     SurfacePositions& to) {
  to = from;
  retraction.project_drifted(to);
  for (int v : revert_offenders(guards, from, to)) SurfacePosition(from, v).write_to(to, v);
}

void project_drifted(const Guards& guards, Retraction& retraction, SurfacePositions& positions) {
  SurfacePositions projected;
  project_drifted(guards, retraction, positions, projected);
  positions = std::move(projected);
}

double cotangent_limit(const Mat3X& points, const std::vector<Triangle>& faces) {
  return max_cotangent(points, faces) / (1 + cotangent_reserve);
}

FinalProjection::FinalProjection(Workspace& work, const ShapeLimits& limits)
    : work_(work), step_limits_(limits) {}

Guards FinalProjection::guards() const {
  ShapeLimits limits = step_limits_;
  limits.slack = slack;
  limits.area = area_ratio;
  limits.sagitta = std::numeric_limits<double>::infinity();
  limits.cotangent *= 1 + cotangent_reserve;
  return {*work_.adjacency, work_.targets, limits};
}

void FinalProjection::refit() {
  if (!before_refit_) before_refit_ = {work_.vertices.positions, unprojected_};
  work_.refit();
}

int FinalProjection::project() {
  const Stage stage(work_.stopwatch, "land");
  SurfacePositions projected = work_.project_to_input();
  unprojected_ = revert_offenders(guards(), work_.vertices.positions, projected);
  work_.vertices.positions = std::move(projected);
  reverted_crossings_ = false;
  if (before_refit_) undo_crossings();
  return static_cast<int>(unprojected_.size());
}

int FinalProjection::project(const std::vector<int>& vertices) {
  const Stage stage(work_.stopwatch, "land");
  const SurfacePositions before = work_.vertices.positions;
  work_.to_input().project_drifted(vertices, work_.vertices.positions);
  std::erase_if(unprojected_, [&](int v) { return std::ranges::binary_search(vertices, v); });
  const std::vector<int> stay = revert_offenders(guards(), before, vertices, work_.vertices.positions);
  unprojected_.insert(unprojected_.end(), stay.begin(), stay.end());
  return static_cast<int>(unprojected_.size());
}

/// Pre-condition: all vertices are tracked on the field of the input again.
void FinalProjection::undo_crossings() {
  const Stage stage(work_.stopwatch, "crossings");
  const Projected before = *std::exchange(before_refit_, std::nullopt);
  const std::vector<int> back = revert_crossings(guards(), *work_.adjacency, work_.vertices.constraints,
                                                 before.positions, work_.vertices.positions);
  reverted_crossings_ = !back.empty();
  if (!reverted_crossings_) return;
  work_.track_on_input(work_.vertices.positions.hints);
  const auto is_back = [&](int v) { return std::ranges::binary_search(back, v); };
  std::erase_if(unprojected_, is_back);
  std::ranges::copy_if(before.unprojected, std::back_inserter(unprojected_), is_back);
}

}  // namespace hooke
