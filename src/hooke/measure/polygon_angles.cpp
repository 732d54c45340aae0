#include "hooke/measure/polygon_angles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numbers>
#include <span>

#include "hooke/core/lists.h"
#include "hooke/mesh/normals.h"

namespace hooke {

namespace {

/// Calls use(angle, deviation), in degrees, for each corner of a polygon.
template <typename Use>
void for_each_corner(const Mat3X& points, std::span<const int> corners, const Use& use) {
  constexpr double degrees = 180 / std::numbers::pi;
  const std::size_t n = corners.size();
  const Vec3 normal = newell_normal(points, corners);
  const double regular = 180 - 360 / static_cast<double>(n);
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3 x = points.col(corners[k]);
    const Vec3 next = points.col(corners[(k + 1) % n]) - x, last = points.col(corners[(k + n - 1) % n]) - x;
    const Vec3 cross = next.cross(last);
    double angle = degrees * std::atan2(cross.norm(), next.dot(last));
    if (cross.dot(normal) < 0) angle = 360 - angle;
    use(angle, angle - regular);
  }
}

double rms_deviation(const Mat3X& points, std::span<const int> corners) {
  double squares = 0;
  for_each_corner(points, corners, [&](double, double deviation) { squares += deviation * deviation; });
  return std::sqrt(squares / static_cast<double>(corners.size()));
}

}  // namespace

std::optional<PolygonAngles> measure_polygon_angles(const Mat3X& points, const IntLists& polygons) {
  PolygonAngles all{.min = std::numeric_limits<double>::infinity()};
  double squares = 0;
  std::size_t count = 0;
  for (int p = 0; p + 1 < std::ssize(polygons.first); ++p) {
    if (polygons[p].size() <= 3) continue;
    for_each_corner(points, polygons[p], [&](double angle, double deviation) {
      all.min = std::min(all.min, angle);
      all.max = std::max(all.max, angle);
      squares += deviation * deviation;
    });
    count += polygons[p].size();
  }
  if (count == 0) return std::nullopt;
  all.rms_deviation = std::sqrt(squares / static_cast<double>(count));
  return all;
}

std::vector<int> vertices_of_worse_polygons(const Mat3X& points, const Mat3X& before,
                                            const IntLists& polygons, double margin) {
  std::vector<int> vertices;
  for (int p = 0; p + 1 < std::ssize(polygons.first); ++p) {
    const std::span<const int> corners = polygons[p];
    if (corners.size() > 3 && rms_deviation(points, corners) > rms_deviation(before, corners) + margin)
      vertices.insert(vertices.end(), corners.begin(), corners.end());
  }
  sort_unique(vertices);
  return vertices;
}

}  // namespace hooke
