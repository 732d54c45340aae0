#include "hooke/measure/polygon_angles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numbers>
#include <span>

#include "hooke/mesh/normals.h"

namespace hooke {

std::optional<PolygonAngles> measure_polygon_angles(const Mat3X& points, const IntLists& polygons) {
  constexpr double degrees = 180 / std::numbers::pi;
  PolygonAngles all{.min = std::numeric_limits<double>::infinity()};
  double squares = 0;
  std::size_t count = 0;
  for (int p = 0; p + 1 < std::ssize(polygons.first); ++p) {
    const std::span<const int> corners = polygons[p];
    const std::size_t n = corners.size();
    if (n <= 3) continue;
    const Vec3 normal = newell_normal(points, corners);
    const double regular = 180 - 360 / static_cast<double>(n);
    for (std::size_t k = 0; k < n; ++k) {
      const Vec3 x = points.col(corners[k]);
      const Vec3 next = points.col(corners[(k + 1) % n]) - x, last = points.col(corners[(k + n - 1) % n]) - x;
      const Vec3 cross = next.cross(last);
      double angle = degrees * std::atan2(cross.norm(), next.dot(last));
      if (cross.dot(normal) < 0) angle = 360 - angle;
      all.min = std::min(all.min, angle);
      all.max = std::max(all.max, angle);
      squares += (angle - regular) * (angle - regular);
    }
    count += n;
  }
  if (count == 0) return std::nullopt;
  all.rms_deviation = std::sqrt(squares / static_cast<double>(count));
  return all;
}

}  // namespace hooke
