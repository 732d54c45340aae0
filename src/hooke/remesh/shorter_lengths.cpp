#include "hooke/remesh/shorter_lengths.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "hooke/core/uniform_vector.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/mesh.h"
#include "hooke/mesh/normals.h"
#include "hooke/mesh/surface_point.h"
#include "hooke/springs/sizing.h"

namespace hooke {
namespace {

constexpr double max_bend = 45;       // degrees, within an edge
constexpr double smooth_share = .85;  // maximum bend of the input there, over that of the result
constexpr double crease_reach = .3;   // of an edge, from its middle: a crease so near is what bends there

constexpr double few_bends = .0005;  // of all edges: not worth another attempt

/// How a surface bends, in degrees: across its edges, and along its curves, which are creases and boundaries.
class Bends {
 public:
  /// Keeps a reference to the surface. The creases are edges of its adjacency.
  Bends(const MeasuredSurface& surface, std::vector<Edge> creases)
      : surface_(surface),
        across_(surface.adjacency.edges.size(), 0),
        is_on_curve_(surface.adjacency.edges.size(), 0),
        curve_ends_(surface.adjacency.vertex_count) {
    const Adjacency& c = surface.adjacency;
    const Mat3X normals = certain_face_normals(surface.points, c);
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
    const Vec3 x = surface_.points.col(vertex);
    return angle_between(x - surface_.points.col(ends[0]), surface_.points.col(ends[1]) - x);
  }

  /// The other ends of the edges of curves at the vertex.
  const std::vector<int>& ends(int vertex) const { return curve_ends_[vertex]; }

  /// The edges of curves.
  const std::vector<int>& curves() const { return curves_; }

 private:
  const MeasuredSurface& surface_;
  std::vector<double> across_;
  std::vector<char> is_on_curve_;
  std::vector<std::vector<int>> curve_ends_;
  std::vector<int> curves_;
};

/// The input of attempts, to ask where it is smooth.
class SmoothParts {
 public:
  SmoothParts(const MeasuredSurface& input, std::vector<Edge> creases)
      : input_(input), bends_(input, std::move(creases)), curves_(input.points, segments()) {}

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

/// A place where a result bends by an angle in degrees.
struct Bend {
  Vec3 from, to;
  double angle;
  double target;  // length there
  double width;   // within which it bends: of its edges or faces there, at most that length
};

/// Where smooth parts of the input bend too much within an edge of the result.
std::vector<Bend> unresolved_bends(const AttemptMaker& maker, const Attempt& attempt) {
  const MeasuredSurface surface = maker.surface_of(attempt);
  const Bends bends(surface, sorted_creases(attempt));
  const SmoothParts input(maker.input(), maker.input_creases(attempt));
  const std::vector<double> lengths =
      attempt.result.memory_order.order.gather(vertex_values(attempt.mesh, target_length_property));
  std::vector<Bend> unresolved;
  const Adjacency& c = surface.adjacency;
  for (int e = 0; e < std::ssize(c.edges); ++e) {
    const double angle = bends.across(e);
    if (angle <= max_bend || bends.is_on_curve(e)) continue;
    const auto& [v, w] = c.edges[e];
    const Vec3 from = surface.points.col(v), to = surface.points.col(w);
    if (!input.bends_less_across(.5 * (from + to), surface.shell_of_vertex(v), smooth_share * angle,
                                 crease_reach * (to - from).norm()))
      continue;
    double width = 0;  // mean of the faces
    for (int f : c.edge_faces[e])
      width += .5 * doubled_area_vector(surface.points, c.faces[f]).norm() / (to - from).norm();
    const double target = std::min(lengths[v], lengths[w]);
    unresolved.push_back({from, to, angle, target, std::min(target, width)});
  }
  for (int v = 0; v < c.vertex_count; ++v) {
    const std::optional<double> angle = bends.along(v);
    const Vec3 x = surface.points.col(v);
    if (!angle || *angle <= max_bend || !input.bends_less_along(x, smooth_share * *angle)) continue;
    double length = 0;  // mean of the edges
    for (int end : bends.ends(v)) length += .5 * (surface.points.col(end) - x).norm();
    unresolved.push_back({x, x, *angle, lengths[v], std::min(lengths[v], length)});
  }
  return unresolved;
}

}  // namespace

std::optional<AskedLengths> ShorterLengths::resolving_bends(const Attempt& attempt, double max_faces) const {
  const std::vector<Bend> bends = unresolved_bends(maker_, attempt);
  if (static_cast<double>(bends.size()) < few_bends * static_cast<double>(attempt.mesh.n_edges()))
    return std::nullopt;
  constexpr double fine_bend = 33, coarser = 4. / 3, more_faces = 2;
  const auto lengths_at = [&](double bend, double Bend::*length) {
    AskedLengths lengths = attempt.lengths;
    for (const Bend& b : bends)
      lengths.shorter.push_back({b.from, b.to, b.*length * std::min(1., bend / b.angle)});
    return lengths;
  };
  for (const auto length : {&Bend::width, &Bend::target})
    for (double bend = fine_bend; bend < 2 * max_bend; bend *= coarser) {
      AskedLengths lengths = lengths_at(bend, length);
      const bool may_be_more = length == &Bend::width && bend > fine_bend;
      const double most = may_be_more ? more_faces * max_faces : max_faces;
      if (faces_of(lengths, most) <= most) return lengths;
    }
  return std::nullopt;
}

/// By how much to shorten lengths where a distance is `excess` times its limit. Where a limit is asked for
/// it tells: distances of chords of a smooth surface grow with the square of lengths.
double ShorterLengths::shortening(double excess) const {
  constexpr double least = .25, most = .6485, without_limit = .42;  // most: 2^(-5/8), see PlacedLengths
  if (!maker_.has_tolerance()) return without_limit;
  return std::isfinite(excess) ? std::clamp(most / std::sqrt(excess), least, most) : .5;
}

double ShorterLengths::faces_of(const AskedLengths& lengths, double enough) const {
  const Adjacency& c = maker_.input().adjacency;
  if (!lengths.shorter.empty())
    return placed(lengths).covering_faces(maker_.input().points, c.faces, lengths.of_vertices, enough);
  const double length =
      covering_length(maker_.input().points, c, spread_target_lengths(c, lengths.of_vertices));
  return total_area(maker_.input().points, c.faces) / (std::numbers::sqrt3 / 4 * length * length);
}

PlacedLengths ShorterLengths::placed(const AskedLengths& lengths) const {
  const double mean = std::accumulate(asked_.begin(), asked_.end(), 0.) / static_cast<double>(asked_.size());
  return {lengths.shorter, mean, Sizing().gradation};
}

void ShorterLengths::shorten_at(const std::vector<FlawPlace>& flaws, const Attempt& last,
                                AskedLengths& lengths) const {
  const PlacedLengths places = placed(lengths);
  std::vector<PlacedLength> shorter;
  for (const FlawPlace& flaw : flaws) {
    const Vec3 middle = .5 * (flaw.from + flaw.to);
    const double present =
        last.result.rescue == Rescue::kept_faces ? places.length_at(middle, asked_at(middle)) : flaw.length;
    shorter.push_back({flaw.from, flaw.to, present * shortening(flaw.excess)});
  }
  lengths.shorter.insert(lengths.shorter.end(), shorter.begin(), shorter.end());
}

int ShorterLengths::count_in(const Attempt& run) const {
  constexpr double clearly = .8, moved = 1.1;  // since they were sampled
  const std::vector<double> lengths = vertex_values(run.mesh, target_length_property);
  const Mat3X points = vertex_points(run.mesh);
  const PlacedLengths places = placed(run.lengths);
  int count = 0;
  for (Eigen::Index v = 0; v < points.cols(); ++v) {
    const double asked = asked_at(points.col(v)), length = places.length_at(points.col(v), asked);
    count += length < clearly * asked && length <= moved * lengths[v];
  }
  return count;
}

double ShorterLengths::asked_at(const Vec3& x) const {
  if (UniformVector::are_equal(asked_)) return asked_[0];
  const ClosestPoint closest = maker_.input().tree.closest(x);
  if (closest.face < 0) return asked_[0];
  const Triangle& t = maker_.input().adjacency.faces[closest.face];
  const Vec3 weights = on_face(closest, maker_.input().points, maker_.input().adjacency).weights;
  return weights.dot(Vec3(asked_[t[0]], asked_[t[1]], asked_[t[2]]));
}

}  // namespace hooke
