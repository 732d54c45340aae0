#include "hooke/io/reprojected_texture.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <utility>

#include "hooke/io/polygon_triangulation.h"

namespace hooke {
namespace {

// The sets of elements that polygons connect.
class Charts {
 public:
  explicit Charts(Eigen::Index elements) : parents_(static_cast<std::size_t>(elements)) {
    std::iota(parents_.begin(), parents_.end(), 0);
  }

  int find(int element) {
    while (parent(element) != element) element = parent(element) = parent(parent(element));
    return element;
  }
  void unite(int a, int b) {
    const int first = find(a), second = find(b);
    parent(std::max(first, second)) = std::min(first, second);
  }

 private:
  int& parent(int element) { return parents_[element]; }

  std::vector<int> parents_;
};

// A vertex and an element that its corners refer to in some triangle.
struct Use {
  int vertex, element, triangle;
};

// The texture on the triangles.
struct Triangles {
  std::vector<Triangle> vertices, elements;  // elements of the corners, -1 for none
};

Triangles triangles_of(const TextureMotion& motion) {
  TriangulatedPolygons cut = triangulate(motion.before, motion.polygons);
  Triangles result{std::move(cut.triangles), {}};
  for (std::size_t t = 0; t < result.vertices.size(); ++t) {
    const int f = cut.polygon[t];
    const std::span<const int> corners = motion.polygons[f];
    Triangle& elements = result.elements.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto corner = std::ranges::find(corners, result.vertices[t][k]) - corners.begin();
      elements[k] = motion.elements[motion.polygons.first[f] + corner];
    }
  }
  return result;
}

// All uses of elements, by vertex and element.
std::vector<Use> uses_of(const Triangles& triangles) {
  std::vector<Use> uses;
  for (std::size_t t = 0; t < triangles.vertices.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (triangles.elements[t][k] >= 0)
        uses.push_back({triangles.vertices[t][k], triangles.elements[t][k], static_cast<int>(t)});
  std::ranges::sort(uses, {}, [](const Use& u) { return std::array{u.vertex, u.element, u.triangle}; });
  return uses;
}

Charts charts_of(const TextureMotion& motion, const Triangles& triangles, const std::vector<Use>& uses) {
  Charts charts(motion.values.cols());
  for (const Triangle& t : triangles.elements)
    for (const auto& [a, b] : {std::pair{t[0], t[1]}, {t[1], t[2]}, {t[0], t[2]}})
      if (a >= 0 && b >= 0) charts.unite(a, b);
  for (auto first = uses.begin(); first != uses.end();) {  // equal values at a vertex are no seam
    const auto next =
        std::find_if(first, uses.end(), [&](const Use& u) { return u.vertex != first->vertex; });
    for (auto a = first; a != next; ++a)
      for (auto b = a + 1; b != next && b->element != a->element; ++b)
        if (motion.values.col(a->element) == motion.values.col(b->element))
          charts.unite(a->element, b->element);
    first = next;
  }
  return charts;
}

// Barycentric weights of the point in the plane of the triangle, of any sign.
Vec3 weights_in_plane(const Mat3X& points, const Triangle& t, const Vec3& x) {
  const Vec3 a = points.col(t[0]), ab = points.col(t[1]) - a, ac = points.col(t[2]) - a, ax = x - a;
  const Vec3 normal = ab.cross(ac);
  const double square = normal.squaredNorm();
  if (!(square > 0)) return Vec3(-1, -1, -1);  // fits worse than any other
  const double v = ax.cross(ac).dot(normal) / square, w = ab.cross(ax).dot(normal) / square;
  return {1 - v - w, v, w};
}

Vec3 interpolate(const Mat3X& values, const Triangle& elements, const Vec3& weights) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < 3; ++k) sum += weights[static_cast<Eigen::Index>(k)] * values.col(elements[k]);
  return sum;
}

bool has_all(const Triangle& elements) {
  return std::ranges::all_of(elements, [](int element) { return element >= 0; });
}

// The new value of an element at a vertex; `uses` are those of this vertex and element.
Vec3 new_value(const TextureMotion& motion, const Triangles& triangles, Charts& charts,
               std::span<const Use> uses) {
  const int vertex = uses.front().vertex, element = uses.front().element;
  const SurfacePoint& place = motion.map[vertex].position;
  const auto elements_at = [&](int t) { return triangles.elements[t]; };
  if (place.face >= 0 && has_all(elements_at(place.face)) &&
      charts.find(elements_at(place.face)[0]) == charts.find(element))
    return interpolate(motion.values, elements_at(place.face), place.weights);
  Vec3 best = motion.values.col(element);
  double best_fit = -1;  // farther away than an edge a value is not extrapolated
  for (const Use& use : uses) {
    if (!has_all(elements_at(use.triangle))) continue;
    const Vec3 weights =
        weights_in_plane(motion.before, triangles.vertices[use.triangle], motion.after.col(vertex));
    if (weights.minCoeff() <= best_fit) continue;
    best_fit = weights.minCoeff();
    best = interpolate(motion.values, elements_at(use.triangle), weights);
  }
  return best;
}

}  // namespace

ReprojectedTexture reproject_texture(const TextureMotion& motion) {
  const Triangles triangles = triangles_of(motion);
  const std::vector<Use> uses = uses_of(triangles);
  Charts charts = charts_of(motion, triangles, uses);
  ReprojectedTexture result{motion.values, std::vector<char>(motion.values.cols(), 0)};
  std::vector<char> seen(result.moved.size(), 0), torn(result.moved.size(), 0);
  for (auto first = uses.begin(); first != uses.end();) {
    const auto next = std::find_if(first, uses.end(), [&](const Use& u) {
      return u.vertex != first->vertex || u.element != first->element;
    });
    const bool stays = motion.before.col(first->vertex) == motion.after.col(first->vertex);
    const Vec3 value =
        stays ? Vec3(motion.values.col(first->element)) : new_value(motion, triangles, charts, {first, next});
    const std::size_t e = first->element;
    if (!std::exchange(seen[e], 1))
      result.values.col(first->element) = value;
    else
      torn[e] |= static_cast<char>(result.values.col(first->element) != value);
    first = next;
  }
  for (std::size_t e = 0; e < torn.size(); ++e) {
    const auto column = static_cast<Eigen::Index>(e);
    if (torn[e]) result.values.col(column) = motion.values.col(column);
    result.moved[e] = result.values.col(column) != motion.values.col(column);
  }
  result.torn = static_cast<int>(std::ranges::count(torn, 1));
  return result;
}

}  // namespace hooke
