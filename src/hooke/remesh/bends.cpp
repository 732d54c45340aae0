#include "hooke/remesh/bends.h"

#include <algorithm>
#include <optional>

#include "hooke/geometry/triangle.h"
#include "hooke/mesh/mesh.h"
#include "hooke/mesh/normals.h"
#include "hooke/remesh/attempts.h"
#include "hooke/remesh/flaws.h"

namespace hooke {
namespace {

constexpr double smooth_share = .85;  // maximum bend of the input there, over that of the result
constexpr double crease_reach = .3;   // of an edge, from its middle: a crease so near is what bends there

/// How a surface bends, in degrees: across its edges, and along its curves, which are creases and boundaries.
class Bends {
 public:
  /// Keeps a reference to the points. The creases are edges of the adjacency.
  Bends(const Mat3X& points, const Adjacency& c, std::vector<Edge> creases)
      : points_(points),
        across_(c.edges.size(), 0),
        is_on_curve_(c.edges.size(), 0),
        curve_ends_(c.vertex_count) {
    const Mat3X normals = certain_face_normals(points, c);
    for (Edge& e : creases) std::ranges::sort(e);
    std::ranges::sort(creases);
    for (size_t e = 0; e < across_.size(); ++e) {
      const auto [a, b] = std::minmax(c.edges[e][0], c.edges[e][1]);
      const auto& [left, right] = c.edge_faces[e];
      if (right >= 0) across_[e] = angle_between(normals.col(left), normals.col(right));
      if (right >= 0 && !std::ranges::binary_search(creases, Edge{a, b})) continue;
      is_on_curve_[e] = 1;
      curves_.push_back(static_cast<int>(e));
      curve_ends_[a].push_back(b);
      curve_ends_[b].push_back(a);
    }
  }

  double across(int edge) const { return across_[edge]; }
  bool is_on_curve(int edge) const { return is_on_curve_[edge] != 0; }

  /// Where a curve goes on at the vertex, else none.
  std::optional<double> along(int vertex) const {
    const std::vector<int>& ends = curve_ends_[vertex];
    if (ends.size() != 2) return std::nullopt;
    const Vec3 x = points_.col(vertex);
    return angle_between(x - points_.col(ends[0]), points_.col(ends[1]) - x);
  }

  /// Does it bend by more than the angle anywhere?
  bool exceed(double angle) const {
    for (size_t e = 0; e < across_.size(); ++e)
      if (across_[e] > angle) return true;
    for (int v = 0; v < std::ssize(curve_ends_); ++v)
      if (along(v).value_or(0) > angle) return true;
    return false;
  }

  /// The other ends of the edges of curves at the vertex.
  const std::vector<int>& ends(int vertex) const { return curve_ends_[vertex]; }

  /// The edges of curves.
  const std::vector<int>& curves() const { return curves_; }

 private:
  const Mat3X& points_;
  std::vector<double> across_;
  std::vector<char> is_on_curve_;
  std::vector<std::vector<int>> curve_ends_;
  std::vector<int> curves_;
};

/// The input of attempts, to ask where it is smooth.
class SmoothParts {
 public:
  SmoothParts(const MeasuredSurface& input, std::vector<Edge> creases)
      : input_(input),
        bends_(input.points, input.adjacency, std::move(creases)),
        curves_(input.points, segments()) {}

  /// Does it bend across its edges by less than the angle, at the point of a shell that is closest to x, and
  /// is no crease within reach that bends as much?
  bool bends_less_across(const Vec3& x, int shell, double angle, double reach) const {
    const int face = input_.tree_of(shell).closest(x).face;
    if (face < 0) return false;
    for (int e : input_.adjacency.face_edges[face])
      if (!bends_.is_on_curve(e) && bends_.across(e) >= angle) return false;
    const ClosestPoint curve = curves_.closest(x);
    return curve.face < 0 || curve.squared_distance > reach * reach ||
           bends_.across(bends_.curves()[curve.face]) < angle;
  }

  /// Do its curves go on at both ends of the edge of a curve that is closest to x, by less than the angle?
  bool bends_less_along(const Vec3& x, double angle) const {
    const int curve = curves_.closest(x).face;
    return curve >= 0 && std::ranges::all_of(input_.adjacency.edges[bends_.curves()[curve]], [&](int end) {
             const std::optional<double> bend = bends_.along(end);
             return bend && *bend < angle;
           });
  }

 private:
  std::vector<Triangle> segments() const {
    std::vector<Triangle> segments;
    for (int e : bends_.curves()) {
      const auto& [a, b] = input_.adjacency.edges[e];
      segments.push_back({a, b, b});
    }
    return segments;
  }

  const MeasuredSurface& input_;
  const Bends bends_;
  const AabbTree curves_;
};

}  // namespace

std::vector<Bend> unresolved_bends(const AttemptMaker& maker, const Attempt& attempt, double max_bend,
                                   double smooth) {
  const auto allowed = [&](double angle) {
    return std::min(smooth_share * angle, std::max(smooth, .5 * angle));
  };
  const MemoryOrder& memory_order = attempt.result.memory_order;
  const Mat3X points = memory_order.order.gather(vertex_points(attempt.mesh));
  const Adjacency& c = *memory_order.adjacency;
  const Bends bends(points, c, sorted_creases(attempt));
  if (!bends.exceed(max_bend)) return {};
  const SmoothParts input(maker.input(), maker.input_creases(attempt));
  const std::vector<double> lengths =
      memory_order.order.gather(vertex_values(attempt.mesh, target_length_property));
  std::vector<Bend> unresolved;
  for (int e = 0; e < std::ssize(c.edges); ++e) {
    const double angle = bends.across(e);
    if (angle <= max_bend) continue;
    const auto& [v, w] = c.edges[e];
    const Vec3 from = points.col(v), to = points.col(w);
    if (!input.bends_less_across(.5 * (from + to), maker.shell_of_vertex(v, attempt), allowed(angle),
                                 crease_reach * (to - from).norm()))
      continue;
    double width = 0;  // mean of the faces
    for (int f : c.edge_faces[e])
      width += .5 * doubled_area_vector(points, c.faces[f]).norm() / (to - from).norm();
    const double target = std::min(lengths[v], lengths[w]);
    unresolved.push_back({from, to, angle, target, std::min(target, width), bends.is_on_curve(e)});
  }
  for (int v = 0; v < c.vertex_count; ++v) {
    const std::optional<double> angle = bends.along(v);
    const Vec3 x = points.col(v);
    if (!angle || *angle <= max_bend || !input.bends_less_along(x, allowed(*angle))) continue;
    double length = 0;  // mean of the edges
    for (int end : bends.ends(v)) length += .5 * (points.col(end) - x).norm();
    unresolved.push_back({x, x, *angle, lengths[v], std::min(lengths[v], length), false});
  }
  return unresolved;
}

std::vector<Bend> sharp_bends(const AttemptMaker& maker, const Attempt& attempt) {
  constexpr double sharp = 60, smooth = 40;  // degrees: of a hexagon and a nonagon
  return unresolved_bends(maker, attempt, sharp, smooth);
}

void note_bends(const AttemptMaker& maker, Attempt& attempt) {
  RemeshResult& result = attempt.result;
  if (!result.measures || attempt.is_interrupted() || result.rescue == Rescue::put_back) return;
  for (const Bend& bend : sharp_bends(maker, attempt)) {
    ++result.sharp_bends;
    if (bend.angle <= result.sharpest_bend) continue;
    result.sharpest_bend = bend.angle;
    result.sharpest_place = .5 * (bend.from + bend.to);
  }
}

}  // namespace hooke
