#include "hooke/remesh/flaws.h"

#include <algorithm>
#include <limits>

#include "hooke/geometry/triangle.h"
#include "hooke/mesh/mesh.h"
#include "hooke/mesh/normals.h"
#include "hooke/remesh/attempts.h"
#include "hooke/remesh/limiting_factors.h"

namespace hooke {

std::vector<Edge> sorted_creases(const Attempt& attempt) {
  std::vector<Edge> creases = attempt.result.memory_order.order.new_edges(attempt.result.crease_edges);
  for (Edge& e : creases) std::ranges::sort(e);
  std::ranges::sort(creases);
  return creases;
}

std::vector<Edge> folds_off_creases(const Attempt& attempt, const Mat3X& points) {
  const std::vector<Edge> creases = sorted_creases(attempt);
  std::vector<Edge> folds;
  const Adjacency& c = *attempt.result.memory_order.adjacency;
  for (std::size_t e = 0; e < c.edges.size(); ++e) {
    if (!is_folded_edge(points, c, static_cast<int>(e))) continue;
    Edge ends = c.edges[e];
    std::ranges::sort(ends);
    if (!std::ranges::binary_search(creases, ends)) folds.push_back(ends);
  }
  return folds;
}

namespace {

/// Per face of the result: is it turned over, or does it intersect others where the input does not?
std::vector<char> wrong_faces(const Attempt& attempt) {
  const std::vector<int>& ids = attempt.result.memory_order.order.old_face;
  const std::vector<int>& flipped = attempt.result.measures->deviation.flipped_faces;
  std::vector<char> is_wrong(ids.size(), 0);
  if (!flipped.empty())
    for (std::size_t f = 0; f < is_wrong.size(); ++f)
      is_wrong[f] = std::ranges::binary_search(flipped, ids[f]);
  for (const auto& pair : attempt.preservation().crossings)
    for (int f : pair) is_wrong[f] = 1;
  return is_wrong;
}

/// Ends of folds of the result that are not kept from the input.
std::vector<int> vertices_at_folds(const Attempt& attempt, const MeasuredSurface& surface) {
  std::vector<int> vertices;
  for (const Edge& ends : folds_off_creases(attempt, surface.points)) {
    const auto is_kept = [&](int v) {
      return (attempt.result.vertex_limits[surface.ids.vertex(v)] & VertexLimit::put_back) != 0;
    };
    if (!std::ranges::all_of(ends, is_kept)) vertices.insert(vertices.end(), ends.begin(), ends.end());
  }
  return vertices;
}

/// The corners of the faces at edges that fold, and more than in the input.
std::vector<int> corners_at_deeper_folds(const MeasuredSurface& input, const Mat3X& points) {
  const Adjacency& c = input.adjacency;
  std::vector<int> corners;
  for (std::size_t e = 0; e < c.edges.size(); ++e) {
    const auto [left, right] = c.edge_faces[e];
    if (right < 0) continue;
    const double fold = cosine_between(points, c.faces[left], c.faces[right]);
    if (fold >= 0 || fold >= cosine_between(input.points, c.faces[left], c.faces[right])) continue;
    for (int f : {left, right}) corners.insert(corners.end(), c.faces[f].begin(), c.faces[f].end());
  }
  return corners;
}

constexpr double beyond_measure = std::numeric_limits<double>::infinity();

void add_excess(const std::vector<FarVertex>& vertices, std::vector<double>& excess) {
  for (const FarVertex& far : vertices)
    excess[far.vertex] = std::max(excess[far.vertex], far.distance / far.limit);
}

std::vector<int> positive(const std::vector<double>& excess) {
  std::vector<int> vertices;
  for (std::size_t v = 0; v < excess.size(); ++v)
    if (excess[v] > 0) vertices.push_back(static_cast<int>(v));
  return vertices;
}

/// Per vertex of the result: its distance over the limit of this if it is too far, infinite at a face that is
/// wrong, apart from folds, else 0.
std::vector<double> excess_at_flaws(const Attempt& attempt, const MeasuredSurface& surface) {
  const Adjacency& c = surface.adjacency;
  const Preservation& p = attempt.preservation();
  std::vector<double> excess(c.vertex_count, 0);
  add_excess(p.far_vertices, excess);
  const auto add = [&](const auto& vertices) {
    for (int v : vertices) excess[v] = beyond_measure;
  };
  const std::vector<char> wrong = wrong_faces(attempt);
  for (std::size_t f = 0; f < wrong.size(); ++f)
    if (wrong[f]) add(c.faces[f]);
  for (int f : p.degenerate_faces) add(c.faces[f]);
  if (attempt.lost_angle)
    for (const Triangle& t : c.faces)
      if (min_angle(surface.points, {t}) < attempt.least_angle) add(t);
  return excess;
}

/// The same, with folds.
std::vector<double> excess_at_vertices(const Attempt& attempt, const MeasuredSurface& surface) {
  std::vector<double> excess = excess_at_flaws(attempt, surface);
  if (attempt.preservation().new_folds > 0)
    for (int v : vertices_at_folds(attempt, surface)) excess[v] = beyond_measure;
  return excess;
}

}  // namespace

std::vector<double> excess_at_input(const AttemptMaker& maker, const Attempt& attempt) {
  const MeasuredSurface& input = maker.input();
  const MeasuredSurface surface = maker.surface_of(attempt);
  const Preservation& p = attempt.preservation();
  const Adjacency& c = input.adjacency;
  std::vector<double> at_input(c.vertex_count, 0);
  add_excess(p.lost_vertices, at_input);
  const auto add_closest = [&](const Vec3& x, double excess, const AabbTree& tree, const auto& is_meant) {
    const int face = tree.closest(x, is_meant).face;
    if (face < 0) return;
    for (int v : c.faces[face]) at_input[v] = std::max(at_input[v], excess);
  };
  const std::vector<double> excess = excess_at_vertices(attempt, surface);
  const Mat3X normals = vertex_normals(surface.points, surface.adjacency),
              input_normals = face_normals(input.points, c);
  for (int v = 0; v < surface.adjacency.vertex_count; ++v)  // of its own shell, on the same side
    if (excess[v] > 0)
      add_closest(surface.points.col(v), excess[v], input.tree_of(surface.shell_of_vertex(v)),
                  [&](int f) { return input_normals.col(f).dot(normals.col(v)) > 0; });
  for (const Edge& lost : p.lost_creases)
    for (int v : lost) at_input[v] = beyond_measure;
  if (!p.within_max_distance) add_closest(p.place, p.excess, input.tree, [](int) { return true; });
  return at_input;
}

std::vector<FlawPlace> places_of_flaws(const AttemptMaker& maker, const Attempt& attempt) {
  const MeasuredSurface& input = maker.input();
  const MeasuredSurface surface = maker.surface_of(attempt);
  const Preservation& p = attempt.preservation();
  const std::vector<double> lengths =
      attempt.result.memory_order.order.gather(vertex_values(attempt.mesh, target_length_property));
  std::vector<FlawPlace> places;
  const auto add = [&](const Vec3& from, const Vec3& to, double excess, const AabbTree& tree) {
    const int face = tree.closest(.5 * (from + to)).face;
    if (face < 0) return;
    double length = std::numeric_limits<double>::infinity();
    for (int v : surface.adjacency.faces[face]) length = std::min(length, lengths[v]);
    places.push_back({from, to, excess, length});
  };
  const auto tree_at = [&](int input_vertex) -> const AabbTree& {
    return surface.tree_of(input.shell_of_vertex(input_vertex));
  };
  const std::vector<double> excess = excess_at_vertices(attempt, surface);
  for (int v = 0; v < surface.adjacency.vertex_count; ++v)
    if (const Vec3 x = surface.points.col(v); excess[v] > 0) places.push_back({x, x, excess[v], lengths[v]});
  for (const FarVertex& lost : p.lost_vertices) {
    const Vec3 x = input.points.col(lost.vertex);
    add(x, x, lost.distance / lost.limit, tree_at(lost.vertex));
  }
  for (const auto& [a, b] : p.lost_creases)
    add(input.points.col(a), input.points.col(b), beyond_measure, tree_at(a));
  if (!p.within_max_distance) add(p.place, p.place, p.excess, surface.tree);
  return places;
}

std::vector<int> input_vertices_at_flaws(const AttemptMaker& maker, const Attempt& attempt) {
  return positive(excess_at_input(maker, attempt));
}

std::vector<int> flaws_at_vertices(const Attempt& attempt, const Mat3X& points) {
  const Adjacency& c = *attempt.result.memory_order.adjacency;
  const Preservation& p = attempt.preservation();
  const Deviation& deviation = attempt.result.measures->deviation;
  std::vector<int> count(c.vertex_count, 0);
  for (const FarVertex& far : p.far_vertices) ++count[far.vertex];
  for (const FarVertex& lost : p.lost_vertices) {
    const int face = deviation.vertices_from_reference.faces[lost.vertex];
    if (face >= 0) ++count[c.faces[face][0]];
  }
  const std::vector<char> is_wrong = wrong_faces(attempt);
  for (std::size_t f = 0; f < is_wrong.size(); ++f) count[c.faces[f][0]] += is_wrong[f];
  for (const Edge& fold : folds_off_creases(attempt, points)) ++count[fold[0]];
  for (int f : p.degenerate_faces) ++count[c.faces[f][0]];
  return count;
}

std::vector<int> vertices_to_put_back(const AttemptMaker& maker, const Attempt& attempt) {
  const MeasuredSurface surface = maker.surface_of(attempt);
  const Preservation& p = attempt.preservation();
  std::vector<double> excess = excess_at_flaws(attempt, surface);
  if (p.new_folds > 0)
    for (int v : corners_at_deeper_folds(maker.input(), surface.points)) excess[v] = beyond_measure;
  add_excess(p.lost_vertices, excess);
  for (const Edge& lost : p.lost_creases)
    for (int v : lost) excess[v] = beyond_measure;
  return positive(excess);
}

}  // namespace hooke
