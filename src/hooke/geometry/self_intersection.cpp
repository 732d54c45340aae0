#include "hooke/geometry/self_intersection.h"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "hooke/core/parallel.h"
#include "hooke/geometry/predicates.h"

namespace hooke {
namespace {

using Corners = std::array<Vec3, 3>;
using Corners2 = std::array<Vec2, 3>;

Vec2 drop_axis(const Vec3& p, int axis) {
  return {p[(axis + 1) % 3], p[(axis + 2) % 3]};
}

/// An axis along which the triangle can be projected without losing its area.
int flattening_axis(const Corners& t) {
  const Vec3 n = (t[1] - t[0]).cross(t[2] - t[0]).cwiseAbs();
  std::array<int, 3> axes = {0, 1, 2};
  std::ranges::sort(axes, {}, [&](int i) { return std::pair(-n[i], i); });
  for (int axis : axes)  // the order of the axes is subject to rounding
    if (orient2d(drop_axis(t[0], axis), drop_axis(t[1], axis), drop_axis(t[2], axis)) != 0) return axis;
  return axes[0];
}

bool same_side(int i, int j, int k) {
  return (i >= 0 && j >= 0 && k >= 0) || (i <= 0 && j <= 0 && k <= 0);
}

bool contains(const Corners2& t, const Vec2& p) {
  return same_side(orient2d(t[0], t[1], p), orient2d(t[1], t[2], p), orient2d(t[2], t[0], p));
}

/// Pre-condition: p lies on the line through a and b.
bool between(const Vec2& a, const Vec2& b, const Vec2& p) {
  return (p.array() >= a.array().min(b.array())).all() && (p.array() <= a.array().max(b.array())).all();
}

bool segments_meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const int abc = orient2d(a, b, c), abd = orient2d(a, b, d);
  const int cda = orient2d(c, d, a), cdb = orient2d(c, d, b);
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && between(a, b, c)) || (abd == 0 && between(a, b, d)) || (cda == 0 && between(c, d, a)) ||
         (cdb == 0 && between(c, d, b));
}

/// Pre-condition: all five points lie in one plane.
bool segment_meets_triangle_in_plane(const Vec3& p, const Vec3& q, const Corners& t) {
  const int axis = flattening_axis(t);
  const Vec2 a = drop_axis(p, axis), b = drop_axis(q, axis);
  const Corners2 flat = {drop_axis(t[0], axis), drop_axis(t[1], axis), drop_axis(t[2], axis)};
  if (contains(flat, a)) return true;
  for (size_t k = 0; k < 3; ++k)
    if (segments_meet(a, b, flat[k], flat[(k + 1) % 3])) return true;
  return false;
}

/// Whether the segment p q meets the triangle; `side_p` and `side_q` are the sides of its plane on which p
/// and q lie.
bool segment_meets_triangle(const Vec3& p, const Vec3& q, const Corners& t, int side_p, int side_q) {
  if (side_p * side_q > 0) return false;
  if (side_p == 0 && side_q == 0) return segment_meets_triangle_in_plane(p, q, t);
  return same_side(orient3d(p, q, t[0], t[1]), orient3d(p, q, t[1], t[2]), orient3d(p, q, t[2], t[0]));
}

/// Bounds on the rounding error of the dot product of a vector with a difference of points: relative to
/// the sum of the absolute values of its terms, and absolute for underflow.
constexpr double rounding_bound = 1e-14;
constexpr double underflow_bound = 1e-280;

double size_of(const Vec3& v) {
  return v.lpNorm<1>();
}

/// Whether a plane across the direction certainly separates the triangles, with t on its outer side.
bool surely_separates(const Vec3& across, const Corners& s, const Corners& t) {
  double last_of_s = 0, first_of_t = std::numeric_limits<double>::infinity(), farthest = 0;
  for (size_t k = 0; k < 3; ++k) {
    const Vec3 to_s = s[k] - s[0], to_t = t[k] - s[0];
    last_of_s = std::max(last_of_s, across.dot(to_s));
    first_of_t = std::min(first_of_t, across.dot(to_t));
    farthest = std::max({farthest, size_of(to_s), size_of(to_t)});
  }
  return first_of_t - last_of_s > rounding_bound * farthest * size_of(across) + underflow_bound;
}

/// Whether the second triangle certainly lies beyond an edge of the first. It does for needles side by side
/// in a plane, of which a concave cap may have thousands.
bool surely_beyond_an_edge(const Corners& s, const Corners& t) {
  const Vec3 normal = (s[1] - s[0]).cross(s[2] - s[0]);
  for (size_t k = 0; k < 3; ++k)
    if (surely_separates((s[(k + 1) % 3] - s[k]).cross(normal), s, t)) return true;
  return false;
}

/// Whether a plane certainly separates the triangles: one between the centres, which does for most candidate
/// pairs, whose boxes overlap only because they are close, or one along an edge.
bool surely_apart(const Corners& s, const Corners& t) {
  return surely_separates((t[0] - s[0]) + (t[1] - s[1]) + (t[2] - s[2]), s, t) ||
         surely_beyond_an_edge(s, t) || surely_beyond_an_edge(t, s);
}

/// surely_apart() for two triangles that share their corner 0, with a plane through that corner: between
/// their middles, or between the edges that are closest.
bool surely_apart_but_for_corner(const Corners& s, const Corners& t) {
  const std::array<Vec3, 2> of_s = {s[1] - s[0], s[2] - s[0]}, of_t = {t[1] - t[0], t[2] - t[0]};
  const double farthest = std::max({size_of(of_s[0]), size_of(of_s[1]), size_of(of_t[0]), size_of(of_t[1])});
  const auto separates = [&](const Vec3& across) {
    const double last_of_s = std::max(across.dot(of_s[0]), across.dot(of_s[1]));
    const double first_of_t = std::min(across.dot(of_t[0]), across.dot(of_t[1]));
    const double margin = rounding_bound * farthest * size_of(across) + underflow_bound;
    return last_of_s < -margin && first_of_t > margin;
  };
  if (separates((of_t[0] + of_t[1]).normalized() - (of_s[0] + of_s[1]).normalized())) return true;
  Vec3 shortest = Vec3::Constant(2);
  for (const Vec3& a : of_s)
    for (const Vec3& b : of_t)
      if (const Vec3 across = b.normalized() - a.normalized(); across.squaredNorm() < shortest.squaredNorm())
        shortest = across;
  return separates(shortest);
}

/// Whether two triangles that share their corner 0 share any further point. If they do, the ray from the
/// corner to that point leaves one of them, through the opposite edge, inside the other.
bool corner_sharing_triangles_meet(const Corners& s, const Corners& t) {
  if (surely_apart_but_for_corner(s, t)) return false;
  const int s1 = orient3d(t[0], t[1], t[2], s[1]), s2 = orient3d(t[0], t[1], t[2], s[2]);
  if (s1 * s2 > 0) return false;
  if (s1 == 0 && s2 == 0)
    return segment_meets_triangle_in_plane(s[1], s[2], t) || segment_meets_triangle_in_plane(t[1], t[2], s);
  const int t1 = orient3d(s[0], s[1], s[2], t[1]), t2 = orient3d(s[0], s[1], s[2], t[2]);
  if (t1 * t2 > 0) return false;
  return segment_meets_triangle(s[1], s[2], t, s1, s2) || segment_meets_triangle(t[1], t[2], s, t1, t2);
}

/// Whether two triangles that share the edge of their corners 0 and 1 are folded flat onto each other.
bool is_folded_flat(const Corners& s, const Vec3& tip) {
  if (orient3d(s[0], s[1], s[2], tip) != 0) return false;
  const int axis = flattening_axis(s);
  const Vec2 a = drop_axis(s[0], axis), b = drop_axis(s[1], axis);
  return orient2d(a, b, drop_axis(s[2], axis)) * orient2d(a, b, drop_axis(tip, axis)) > 0;
}

using Face = AabbTree::Face;

/// The corners in cyclic order, beginning with `first`.
Corners corners_from(const Face& face, size_t first) {
  return {face.corners[first], face.corners[(first + 1) % 3], face.corners[(first + 2) % 3]};
}

bool faces_meet(const Face& s, const Face& t) {
  std::array<size_t, 3> in_s{}, in_t{};  // corner indices of the common vertices
  size_t common = 0;
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j)
      if (s.vertices[i] == t.vertices[j]) {
        in_s[common] = i;
        in_t[common] = j;
        ++common;
      }
  if (common == 0) return triangles_meet(s.corners, t.corners);
  if (common == 1) return corner_sharing_triangles_meet(corners_from(s, in_s[0]), corners_from(t, in_t[0]));
  if (common == 3) return false;
  const size_t tip_s = 3 - in_s[0] - in_s[1], tip_t = 3 - in_t[0] - in_t[1];
  return is_folded_flat(corners_from(s, (tip_s + 1) % 3), t.corners[tip_t]);
}

/// The vertex that the faces of both groups share, or -1.
int shared_by_all(std::span<const Face> s, std::span<const Face> t) {
  for (int v : s[0].vertices) {
    const auto has_it = [v](const Face& face) {
      return std::ranges::find(face.vertices, v) != face.vertices.end();
    };
    if (std::ranges::all_of(t, has_it) && std::ranges::all_of(s, has_it)) return v;
  }
  return -1;
}

/// Calls visit(corner - origin) for the corners of the faces other than the vertex.
template <typename Visit>
void for_each_corner_but(int vertex, const Vec3& origin, std::span<const Face> faces, const Visit& visit) {
  for (const Face& face : faces)
    for (size_t k = 0; k < 3; ++k)
      if (face.vertices[k] != vertex) visit(face.corners[k] - origin);
}

/// surely_apart_but_for_corner() for two sectors of the fan around a vertex, each with its faces in about the
/// order of the fan.
bool sectors_surely_apart(int hub, std::span<const Face> s, std::span<const Face> t) {
  const Vec3 origin = s[0].corners[std::ranges::find(s[0].vertices, hub) - s[0].vertices.begin()];
  const auto middle_of = [&](std::span<const Face> faces) {
    Vec3 sum = Vec3::Zero();
    for (const auto& end : {faces.first(1), faces.last(1)})
      for_each_corner_but(hub, origin, end, [&](const Vec3& d) { sum += d.normalized(); });
    return sum.normalized();
  };
  const Vec3 across = middle_of(t) - middle_of(s);
  bool apart = true;
  const auto check = [&](std::span<const Face> faces, const Vec3& inward) {
    for_each_corner_but(hub, origin, faces, [&](const Vec3& d) {
      const double margin = rounding_bound * size_of(d) * size_of(across) + underflow_bound;
      apart = apart && inward.dot(d) > margin;
    });
  };
  check(t, across);
  check(s, -across);
  return apart;
}

/// Whether no face of one group certainly meets one of the other beyond a vertex that all share.
bool groups_surely_apart(std::span<const Face> s, std::span<const Face> t) {
  const int hub = shared_by_all(s, t);
  return hub >= 0 && sectors_surely_apart(hub, s, t);
}

}  // namespace

bool triangles_meet(const Corners& s, const Corners& t) {
  if (surely_apart(s, t)) return false;
  std::array<int, 3> side_s, side_t;
  for (size_t k = 0; k < 3; ++k) side_t[k] = orient3d(s[0], s[1], s[2], t[k]);
  if (side_t[0] != 0 && side_t[0] == side_t[1] && side_t[1] == side_t[2]) return false;
  for (size_t k = 0; k < 3; ++k) side_s[k] = orient3d(t[0], t[1], t[2], s[k]);
  if (side_s[0] != 0 && side_s[0] == side_s[1] && side_s[1] == side_s[2]) return false;
  for (size_t k = 0; k < 3; ++k) {
    const size_t next = (k + 1) % 3;
    if (segment_meets_triangle(s[k], s[next], t, side_s[k], side_s[next])) return true;
    if (segment_meets_triangle(t[k], t[next], s, side_t[k], side_t[next])) return true;
  }
  return false;
}

namespace {

/// The middle between the points of two segments that are closest to each other, and their squared distance.
ClosestPoint nearest_between_edges(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, v = d - c, w = a - c;
  const double uu = u.squaredNorm(), uv = u.dot(v), vv = v.squaredNorm(), area = uu * vv - uv * uv;
  const double along = area > 0 ? std::clamp((uv * v.dot(w) - vv * u.dot(w)) / area, 0., 1.) : 0;
  const double other = std::clamp(v.dot(w + along * u) / vv, 0., 1.);
  const Vec3 y = c + other * v, x = a + std::clamp(u.dot(y - a) / uu, 0., 1.) * u;
  return {.5 * (x + y), (x - y).squaredNorm()};
}

/// A point between two triangles where they are closest to each other.
Vec3 nearest_between(const Corners& s, const Corners& t) {
  ClosestPoint nearest;
  const auto keep_nearer = [&](const ClosestPoint& candidate) {
    if (candidate.squared_distance < nearest.squared_distance) nearest = candidate;
  };
  for (size_t k = 0; k < 3; ++k) {
    keep_nearer(closest_point(s[k], t[0], t[1], t[2]));
    keep_nearer(closest_point(t[k], s[0], s[1], s[2]));
    for (size_t l = 0; l < 3; ++l)
      keep_nearer(nearest_between_edges(s[k], s[(k + 1) % 3], t[l], t[(l + 1) % 3]));
  }
  return nearest.point;
}

}  // namespace

std::array<Vec3, 2> crossing_segment(const Corners& s, const Corners& t) {
  std::vector<Vec3> ends;
  const auto add_piercings = [&](const Corners& edges_of, const Corners& plane_of) {
    const Vec3 normal = (plane_of[1] - plane_of[0]).cross(plane_of[2] - plane_of[0]);
    const auto height = [&](const Vec3& x) { return normal.dot(x - plane_of[0]); };
    for (size_t k = 0; k < 3; ++k) {
      const Vec3 &a = edges_of[k], &b = edges_of[(k + 1) % 3];
      const double from = height(a), to = height(b);
      if ((from < 0) == (to < 0)) continue;
      const Vec3 x = a + from / (from - to) * (b - a);
      const auto is_inside = [&](size_t i) {
        return normal.dot((plane_of[(i + 1) % 3] - plane_of[i]).cross(x - plane_of[i])) >= 0;
      };
      if (is_inside(0) && is_inside(1) && is_inside(2)) ends.push_back(x);
    }
  };
  add_piercings(s, t);
  add_piercings(t, s);
  if (ends.empty()) ends.push_back(nearest_between(s, t));
  const auto farthest =
      std::ranges::max_element(ends, {}, [&](const Vec3& x) { return (x - ends.front()).squaredNorm(); });
  return {ends.front(), *farthest};
}

std::vector<std::array<int, 2>> find_self_intersections(const AabbTree& tree) {
  constexpr size_t faces_per_task = 1024, parts_per_task = 64;
  const std::span<const Face> faces = tree.faces();
  std::vector<char> has_area(faces.size());  // by id
  parallel_for(faces.size(), faces_per_task, [&](size_t begin, size_t end) {
    for (size_t k = begin; k < end; ++k)
      has_area[faces[k].id] = !is_collinear(faces[k].corners[0], faces[k].corners[1], faces[k].corners[2]);
  });

  std::vector<std::vector<std::array<int, 2>>> found(tree.parts() / parts_per_task + 1);
  parallel_for(tree.parts(), parts_per_task, [&](size_t begin, size_t end) {
    tree.for_each_overlapping_pair(begin, end, groups_surely_apart, [&](const Face& f, const Face& g) {
      const auto [low, high] = std::minmax(f.id, g.id);
      if (!has_area[low] || !has_area[high]) return;
      if (f.id < g.id ? faces_meet(f, g) : faces_meet(g, f))
        found[begin / parts_per_task].push_back({low, high});
    });
  });
  std::vector<std::array<int, 2>> pairs;
  for (const auto& part : found) pairs.insert(pairs.end(), part.begin(), part.end());
  std::sort(pairs.begin(), pairs.end());  // the tree visits the pairs in its own order
  return pairs;
}

std::vector<std::array<int, 2>> find_self_intersections(const Mat3X& points,
                                                        const std::vector<Triangle>& faces) {
  return find_self_intersections(AabbTree(points, faces));
}

}  // namespace hooke
