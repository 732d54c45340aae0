#include "hooke/mesh/mirror.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "hooke/geometry/aabb_tree.h"

namespace hooke {
namespace {

/// The corners in their order, the smallest first.
std::vector<int> from_smallest(std::vector<int> corners) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

/// The images of the vertices; none if the mirror does not map them onto each other.
std::optional<std::vector<int>> images(const Mirror& mirror, const Mat3X& points, const AabbTree& tree,
                                       double reach) {
  const auto count = static_cast<int>(points.cols());
  std::vector<int> image(count);
  for (int v = 0; v < count; ++v) {
    const ClosestPoint closest = tree.closest(mirror(points.col(v)));
    if (closest.face < 0 || closest.squared_distance > reach * reach) return std::nullopt;
    image[v] = closest.face;
  }
  for (int v = 0; v < count; ++v)
    if (image[image[v]] != v) return std::nullopt;
  return image;
}

bool maps_polygons(const std::vector<int>& image, const IntLists& polygons) {
  std::vector<std::vector<int>> all;
  const int count = static_cast<int>(polygons.first.size()) - 1;
  for (int f = 0; f < count; ++f) all.push_back(from_smallest({polygons[f].begin(), polygons[f].end()}));
  std::ranges::sort(all);
  for (int f = 0; f < count; ++f) {
    std::vector<int> mirrored;
    for (int v : polygons[f]) mirrored.push_back(image[v]);
    std::ranges::reverse(mirrored);
    if (!std::ranges::binary_search(all, from_smallest(std::move(mirrored)))) return false;
  }
  return true;
}

}  // namespace

std::vector<Mirror> find_mirrors(const Mat3X& points, const IntLists& polygons) {
  const Vec3 low = points.rowwise().minCoeff(), high = points.rowwise().maxCoeff(),
             mean = points.rowwise().mean();
  const double reach = mirror_tolerance * (high - low).norm();
  std::vector<Mirror> mirrors;
  std::optional<AabbTree> tree;
  for (int axis = 0; axis < 3; ++axis) {
    Mirror mirror{axis, .5 * (low[axis] + high[axis]), {}};
    if (!(std::abs(mean[axis] - mirror.plane) <= reach)) continue;  // as of nearly all meshes
    if (!tree) {
      std::vector<Triangle> places;
      for (int v = 0; v < points.cols(); ++v) places.push_back({v, v, v});
      tree.emplace(points, places);
    }
    std::optional<std::vector<int>> image = images(mirror, points, *tree, reach);
    if (!image || !maps_polygons(*image, polygons)) continue;
    mirror.image = *std::move(image);
    mirrors.push_back(std::move(mirror));
  }
  return mirrors;
}

std::vector<Mirror> find_mirrors(const Mat3X& points, const std::vector<Triangle>& faces) {
  IntLists polygons{{0}, {}};
  for (const Triangle& t : faces) {
    polygons.items.insert(polygons.items.end(), t.begin(), t.end());
    polygons.first.push_back(static_cast<int>(polygons.items.size()));
  }
  return find_mirrors(points, polygons);
}

}  // namespace hooke
