#include "hooke/extent.h"

#include "hooke/parallel.h"

namespace hooke {
namespace {

constexpr size_t block = 4096;

/// Sum over the faces of measure(a, b, c).
template <typename Measure>
double face_sum(const Mat3X& points, const std::vector<Triangle>& faces, const Measure& measure) {
  return parallel_sum(faces.size(), block, [&](size_t begin, size_t end) {
    double sum = 0;
    for (size_t f = begin; f < end; ++f)
      sum += measure(points.col(faces[f][0]), points.col(faces[f][1]), points.col(faces[f][2]));
    return sum;
  });
}

}  // namespace

Extent measure_extent(const Mat3X& points, const Connectivity& connectivity) {
  Extent extent;
  if (connectivity.faces.empty()) return extent;
  Eigen::AlignedBox3d box;
  for (int v = 0; v < connectivity.vertex_count; ++v)
    if (!connectivity.vertex_faces[v].empty()) box.extend(Vec3(points.col(v)));
  extent.lower = box.min();
  extent.upper = box.max();
  extent.diagonal = box.diagonal().norm();
  extent.area = face_sum(points, connectivity.faces, [](const Vec3& a, const Vec3& b, const Vec3& c) {
    return .5 * (b - a).cross(c - a).norm();
  });

  for (const auto& sides : connectivity.edge_faces)
    if (sides[1] < 0) return extent;
  const Vec3 centre = box.center();  // keeps the cones small, and the rounding with them
  extent.volume = face_sum(points, connectivity.faces, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    return (a - centre).dot((b - centre).cross(c - centre)) / 6;
  });
  return extent;
}

}  // namespace hooke
