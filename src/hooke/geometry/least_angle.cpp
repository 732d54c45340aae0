#include "hooke/geometry/least_angle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "hooke/core/parallel.h"

namespace hooke {

double greatest_cotangent(const Mat3X& points, const Triangle& face) {
  const Vec3 p = points.col(face[0]), q = points.col(face[1]), r = points.col(face[2]);
  const Vec3 a = r - q, b = p - r, c = q - p;
  const double a2 = a.squaredNorm(), b2 = b.squaredNorm(), c2 = c.squaredNorm();
  const double cosine = .5 * (a2 + b2 + c2 - 2 * std::min({a2, b2, c2}));  // times the other two lengths
  const double sine = b.cross(c).norm();
  return sine > 0 ? cosine / sine : std::numeric_limits<double>::infinity();
}

double angle_with_cotangent(double cotangent) {
  return std::atan2(1, cotangent) * 180 / std::numbers::pi;
}

double greatest_cotangent(const Mat3X& points, const std::vector<Triangle>& faces) {
  constexpr size_t block = 4096;
  std::vector<double> greatest((faces.size() + block - 1) / block);
  parallel_for(greatest.size(), 1, [&](size_t begin, size_t end) {
    for (size_t b = begin; b < end; ++b) {
      double cotangent = -std::numeric_limits<double>::infinity();
      for (size_t f = b * block; f < std::min(faces.size(), (b + 1) * block); ++f)
        cotangent = std::max(cotangent, greatest_cotangent(points, faces[f]));
      greatest[b] = cotangent;
    }
  });
  return greatest.empty() ? std::numeric_limits<double>::infinity() : *std::ranges::max_element(greatest);
}

double least_angle(const Mat3X& points, const std::vector<Triangle>& faces) {
  return angle_with_cotangent(greatest_cotangent(points, faces));
}

}  // namespace hooke
