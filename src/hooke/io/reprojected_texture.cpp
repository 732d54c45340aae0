#include "hooke/io/reprojected_texture.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <utility>

#include "hooke/geometry/triangle.h"
#include "hooke/io/polygon_triangulation.h"
#include "hooke/mesh/corner_differences.h"
#include "hooke/mesh/mesh.h"

namespace hooke {
namespace {

/// Barycentric weights of the point in the plane of the triangle, of any sign.
Vec3 weights_in_plane(const Mat3X& points, const Triangle& t, const Vec3& x) {
  const Vec3 a = points.col(t[0]), ab = points.col(t[1]) - a, ac = points.col(t[2]) - a, ax = x - a;
  const Vec3 normal = ab.cross(ac);
  const double square = normal.squaredNorm();
  if (!has_reliable_normal(normal, ab, ac - ab, ac))
    return Vec3::Constant(-std::numeric_limits<double>::infinity());
  const double v = ax.cross(ac).dot(normal) / square, w = ab.cross(ax).dot(normal) / square;
  return {1 - v - w, v, w};
}

/// The triangles before the motion, in memory order, with their texture.
class TexturedSurface {
 public:
  TexturedSurface(const Mat3X& points, MemoryOrder order, CornerValues texture)
      : order_(std::move(order)),
        points_(order_.order.gather(points)),
        texture_(std::move(texture)),
        differences_(order_, texture_) {}
  TexturedSurface(const TexturedSurface&) = delete;  // differences_ refers to the other members

  const MemoryOrder& order() const { return order_; }
  const Mat3X& points() const { return points_; }

  /// Elements of the corners of a face.
  const Triangle& elements(int face) const { return texture_.corners[order_.order.old_face[face]]; }

  /// The texture at x, on the side of these faces.
  Vec3 value_near(std::vector<int> faces, const Vec3& x) const {
    std::vector<ClosestPoint> nearest;
    for (const int f : faces) nearest.push_back(closest_on(f, x));
    for (std::size_t i = 0; i < faces.size(); ++i)
      for (const int e : adjacency().face_edges[faces[i]]) {
        if (is_seam(e)) continue;
        const auto& [left, right] = adjacency().edge_faces[e];
        const int next = left == faces[i] ? right : left;
        const ClosestPoint place = closest_on(next, x);
        if (is_farther(place, nearest[i]) || std::ranges::find(faces, next) != faces.end()) continue;
        faces.push_back(next);
        nearest.push_back(place);
      }
    const auto least = std::ranges::min_element(nearest, {}, &ClosestPoint::squared_distance);
    std::size_t best = least - nearest.begin();
    const auto& [a, b, c] = adjacency().faces[faces[best]];
    Vec3 weights = barycentric(least->point, points_.col(a), points_.col(b), points_.col(c));
    double best_fit = -1;  // farther away than an edge a value is not extrapolated
    for (std::size_t i = 0; i < faces.size(); ++i) {
      if (is_farther(nearest[i], *least)) continue;
      const Vec3 in_plane = weights_in_plane(points_, adjacency().faces[faces[i]], x);
      if (in_plane.minCoeff() <= best_fit) continue;
      best_fit = in_plane.minCoeff();
      best = i;
      weights = in_plane;
    }
    const Triangle& corners = elements(faces[best]);
    return weights[0] * texture_.values.col(corners[0]) + weights[1] * texture_.values.col(corners[1]) +
           weights[2] * texture_.values.col(corners[2]);
  }

 private:
  const Adjacency& adjacency() const { return *order_.adjacency; }

  bool is_seam(int edge) const {
    const auto& [a, b] = adjacency().edges[edge];
    return adjacency().is_boundary_edge(edge) || differences_.differ_at(edge, a) ||
           differences_.differ_at(edge, b);
  }

  ClosestPoint closest_on(int face, const Vec3& x) const {
    const Triangle& t = adjacency().faces[face];
    return closest_point(x, points_.col(t[0]), points_.col(t[1]), points_.col(t[2]));
  }

  static bool is_farther(const ClosestPoint& a, const ClosestPoint& b) {
    constexpr double rounding = 1e-9;
    return a.squared_distance > (1 + rounding) * b.squared_distance;
  }

  const MemoryOrder order_;
  const Mat3X points_;
  const CornerValues texture_;
  const CornerDifferences differences_;
};

TexturedSurface surface_of(const TextureMotion& motion) {
  const TriangulatedPolygons cut = triangulate(motion.before, motion.polygons);
  CornerValues texture{motion.values, 3, items_of_triangles(cut, motion.polygons, motion.elements)};
  for (Triangle& elements : texture.corners)
    if (std::ranges::min(elements) < 0) elements = {-1, -1, -1};
  return {motion.before, find_memory_order(static_cast<int>(motion.before.cols()), cut.triangles),
          std::move(texture)};
}

/// A vertex and an element that its corner in a face refers to.
struct Use {
  int element, vertex, face;
};

/// All uses of elements, by element and vertex.
std::vector<Use> uses_of(const TexturedSurface& surface) {
  const std::vector<Triangle>& faces = surface.order().adjacency->faces;
  std::vector<Use> uses;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const int face = static_cast<int>(f), element = surface.elements(face)[k];
      if (element >= 0) uses.push_back({element, faces[f][k], face});
    }
  std::ranges::sort(uses, {}, [](const Use& u) { return std::array{u.element, u.vertex, u.face}; });
  return uses;
}

/// Takes values back until no corner of a polygon is turned over in the texture that was not.
void undo_turned_corners(const TextureMotion& motion, Mat3X& values) {
  const auto doubled_area = [](const Mat3X& points, const Triangle& t) {
    return doubled_area_vector(points, t)[2];
  };
  for (bool changed = true; std::exchange(changed, false);)
    for (std::size_t f = 0; f + 1 < motion.polygons.first.size(); ++f) {
      const int begin = motion.polygons.first[f], size = motion.polygons.first[f + 1] - begin;
      for (int k = 0; k < size; ++k) {
        const auto element = [&](int corner) { return motion.elements[begin + corner % size]; };
        const Triangle corner = {element(k), element(k + 1), element(k + 2)};
        if (std::ranges::min(corner) < 0) continue;
        const double before = doubled_area(motion.values, corner), after = doubled_area(values, corner);
        if (before == 0 || (before > 0 ? after > 0 : after < 0)) continue;
        for (const int e : corner) {
          changed |= values.col(e) != motion.values.col(e);
          values.col(e) = motion.values.col(e);
        }
      }
    }
}

}  // namespace

ReprojectedTexture reproject_texture(const TextureMotion& motion) {
  const TexturedSurface surface = surface_of(motion);
  const Mat3X after = surface.order().order.gather(motion.after);
  const std::vector<Use> uses = uses_of(surface);
  ReprojectedTexture result{motion.values, std::vector<char>(motion.values.cols(), 0)};
  std::vector<char> torn(result.moved.size(), 0);
  int last = -1;  // element
  for (auto first = uses.begin(); first != uses.end();) {
    const auto [element, v, face] = *first;
    const auto next = std::find_if(
        first, uses.end(), [&, e = element, w = v](const Use& u) { return u.vertex != w || u.element != e; });
    Vec3 value = motion.values.col(element);
    if (surface.points().col(v) != after.col(v)) {
      std::vector<int> faces;
      for (auto use = first; use != next; ++use) faces.push_back(use->face);
      value = surface.value_near(std::move(faces), after.col(v));
    }
    if (std::exchange(last, element) != element)
      result.values.col(element) = value;
    else
      torn[element] |= static_cast<char>(result.values.col(element) != value);
    first = next;
  }
  for (Eigen::Index e = 0; e < motion.values.cols(); ++e)
    if (torn[e]) result.values.col(e) = motion.values.col(e);
  undo_turned_corners(motion, result.values);
  for (Eigen::Index e = 0; e < motion.values.cols(); ++e)
    result.moved[e] = result.values.col(e) != motion.values.col(e);
  result.torn = static_cast<int>(std::ranges::count(torn, 1));
  return result;
}

}  // namespace hooke
