#include "hooke/connectivity/edge_flips.h"

#include <cmath>
#include <deque>
#include <numbers>

#include "hooke/constraints/constraints.h"
#include "hooke/core/parallel.h"
#include "hooke/geometry/local_shape.h"
#include "hooke/mesh/halfedge_mesh.h"
#include "hooke/working_mesh/working_mesh.h"

namespace hooke {
namespace {

/// Radians; the tolerance keeps rounding from flipping a square back and forth.
constexpr double delaunay = std::numbers::pi + 1e-9;

/// Minimum share of the area of the two faces in each new face.
constexpr double min_area_share = .02;

/// Angle at p between the directions of a and b, radians.
double angle_at(const Mat3X& points, int p, int a, int b) {
  const Vec3 u = points.col(a) - points.col(p), v = points.col(b) - points.col(p);
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

double area(const Mat3X& points, const Triangle& t) {
  const Vec3 a = points.col(t[0]);
  return .5 * (points.col(t[1]) - a).cross(points.col(t[2]) - a).norm();
}

/// May the vertex from which h starts lose an edge?
bool may_lose_an_edge(const WorkingMesh& m, int h, int slack) {
  const CornerValence corner = corner_valence(m, h);
  return corner.target > 0 ? corner.may_lose(slack) : corner.present > 3;
}

bool may_gain_an_edge(const WorkingMesh& m, int h, int slack) {
  const CornerValence corner = corner_valence(m, h);
  return corner.target == 0 || corner.may_gain(slack);
}

/// Is the sum of the opposite angles certainly less than pi? Its sine tells this without an arctangent.
bool clearly_delaunay(const Mat3X& points, int a, int b, int c, int d) {
  const auto at = [&](int p) {  // sine and cosine of the angle at p, with a common factor
    const Vec3 u = points.col(a) - points.col(p), v = points.col(b) - points.col(p);
    return std::pair(u.cross(v).norm(), u.dot(v));
  };
  const auto [sin_c, cos_c] = at(c);
  const auto [sin_d, cos_d] = at(d);
  return sin_c * cos_d + cos_c * sin_d > 1e-9 * (sin_c + std::abs(cos_c)) * (sin_d + std::abs(cos_d));
}

/// Is the edge non-Delaunay, and is the sum of opposite angles smaller after its flip?
bool improves(const HalfedgeMesh& t, const Mat3X& points, int h) {
  const int a = t.from(h), b = t.to(h), c = t.opposite_vertex(h), d = t.opposite_vertex(t.twin(h));
  if (clearly_delaunay(points, a, b, c, d)) return false;
  const double old_angles = opposite_angles(t, points, h);
  return old_angles > delaunay && angle_at(points, a, c, d) + angle_at(points, b, c, d) < old_angles;
}

std::deque<int> improvable_edges(const HalfedgeMesh& t, const Mat3X& points) {
  std::vector<char> improvable(t.half_edge_count(), 0);
  parallel_for(improvable.size(), 4096, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const int h = static_cast<int>(i);
      improvable[i] = t.twin(h) > h && !t.is_crease(h) && improves(t, points, h);
    }
  });
  std::deque<int> queue;
  for (size_t h = 0; h < improvable.size(); ++h)
    if (improvable[h]) queue.push_back(static_cast<int>(h));
  return queue;
}

/// Does the flip of h make a fold at one of the five edges of its faces? Each edge is compared with itself
/// before the flip, and the new edge with the one it replaces.
bool folds(const WorkingMesh& m, int h, double limit) {
  const HalfedgeMesh& t = m.halfedges;
  const Mat3X& X = m.vertices.positions.points;
  const int a = t.from(h), b = t.to(h), c = t.opposite_vertex(h), g = t.twin(h), d = t.opposite_vertex(g);
  const Triangle left = {c, a, d}, right = {d, b, c};
  const auto breaks = [&](double before, double after) { return after < std::min(limit, before); };
  const auto breaks_across = [&](int half_edge, const Triangle& before, const Triangle& after) {
    const int twin = t.twin(half_edge);
    if (twin < 0 || t.is_crease(half_edge)) return false;
    const Triangle& neighbour = t.faces()[twin / 3];
    return breaks(cosine_between(X, before, neighbour), cosine_between(X, after, neighbour));
  };
  const Triangle of_h = {a, b, c}, of_g = {b, a, d};
  return breaks(cosine_between(X, of_h, of_g), cosine_between(X, left, right)) ||
         breaks_across(HalfedgeMesh::previous(h), of_h, left) ||
         breaks_across(HalfedgeMesh::next(g), of_g, left) ||
         breaks_across(HalfedgeMesh::next(h), of_h, right) ||
         breaks_across(HalfedgeMesh::previous(g), of_g, right);
}

/// Are the two new faces after a flip of h large enough, and their shape within the limits or no worse than
/// that of the two before?
bool keeps_shape(const WorkingMesh& m, int h) {
  const HalfedgeMesh& t = m.halfedges;
  const Mat3X& X = m.vertices.positions.points;
  const Mat3X& N = m.vertices.positions.normals;
  const int g = t.twin(h), opposite_h = HalfedgeMesh::previous(h), opposite_g = HalfedgeMesh::previous(g);
  const int a = t.from(h), b = t.to(h), c = t.from(opposite_h), d = t.from(opposite_g);
  const int sa = t.wedge(h), sb = t.wedge(g), sc = t.wedge(opposite_h), sd = t.wedge(opposite_g);
  const double min_area = min_area_share * (area(X, {a, b, c}) + area(X, {b, a, d}));
  if (!(area(X, {c, a, d}) >= min_area && area(X, {d, b, c}) >= min_area)) return false;
  const double target = target_length(m, c, d);  // also of the old edge, so that sagittas compare
  LocalShape before, after;
  before.add_face(X, N, {a, b, c}, {sa, sb, sc});
  before.add_face(X, N, {b, a, d}, {sb, sa, sd});
  before.add_edge(X, N, {a, b}, {sa, sb}, target);
  after.add_face(X, N, {c, a, d}, {sc, sa, sd});
  after.add_face(X, N, {d, b, c}, {sd, sb, sc});
  after.add_edge(X, N, {c, d}, {sc, sd}, target);
  const ShapeLimits limits;
  return is_within(after, loosened(limits, before)) && !folds(m, h, limits.fold);
}

}  // namespace

double opposite_angles(const HalfedgeMesh& t, const Mat3X& points, int h) {
  const int a = t.from(h), b = t.to(h);
  return angle_at(points, t.opposite_vertex(h), a, b) + angle_at(points, t.opposite_vertex(t.twin(h)), a, b);
}

CornerValence corner_valence(const WorkingMesh& m, int h) {
  const HalfedgeMesh& t = m.halfedges;
  const int target = m.vertices.corner_valences[t.wedge(h)];
  return {target, target > 0 ? static_cast<int>(t.wedge_halfedges(h).size()) + 1 : t.valence(t.from(h))};
}

bool flip_keeps_topology(const WorkingMesh& m, int h, int corner_slack) {
  const HalfedgeMesh& t = m.halfedges;
  if (t.twin(h) < 0 || t.is_crease(h) || is_frozen_edge(m, h)) return false;
  const int g = t.twin(h), opposite_h = HalfedgeMesh::previous(h), opposite_g = HalfedgeMesh::previous(g);
  return may_lose_an_edge(m, h, corner_slack) && may_lose_an_edge(m, g, corner_slack) &&
         may_gain_an_edge(m, opposite_h, corner_slack) && may_gain_an_edge(m, opposite_g, corner_slack) &&
         t.may_connect(t.from(opposite_h), t.from(opposite_g));
}

bool may_flip(const WorkingMesh& m, int h) {
  return flip_keeps_topology(m, h) && keeps_shape(m, h);
}

int flip_to_delaunay(WorkingMesh& m) {
  HalfedgeMesh& t = m.halfedges;
  std::deque<int> queue = improvable_edges(t, m.vertices.positions.points);
  const int limit = 10 * t.half_edge_count();  // on a curved surface flips may cycle
  int flips = 0;
  while (!queue.empty() && flips < limit) {
    const int h = queue.front();
    queue.pop_front();
    if (t.twin(h) < 0 || t.is_crease(h) || !improves(t, m.vertices.positions.points, h) || !may_flip(m, h))
      continue;
    t.flip(h);
    ++flips;
    const int other = t.twin(HalfedgeMesh::flipped(h));
    for (int half_edge : {HalfedgeMesh::flipped(h), other})
      for (int around : {HalfedgeMesh::next(half_edge), HalfedgeMesh::previous(half_edge)})
        queue.push_back(around);
  }
  return flips;
}

}  // namespace hooke
