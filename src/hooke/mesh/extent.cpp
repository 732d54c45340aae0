#include "hooke/mesh/extent.h"

#include <algorithm>

#include "hooke/core/parallel.h"

namespace hooke {
namespace {

constexpr size_t extent_block = 4096;

double face_area(const Mat3X& points, const Triangle& t) {
  const Vec3 a = points.col(t[0]);
  return .5 * (points.col(t[1]) - a).cross(points.col(t[2]) - a).norm();
}

/// Sums over the faces, block by extent_block.
struct Sums {
  double area = 0;
  double volume = 0;  // of the tetrahedra to the centre
};

Sums sum_up(const Mat3X& points, const std::vector<Triangle>& faces, const Vec3& centre) {
  std::vector<Sums> blocks(faces.size() / extent_block + 1);
  parallel_for(faces.size(), extent_block, [&](size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) {
      const Vec3 a = points.col(faces[f][0]), b = points.col(faces[f][1]), c = points.col(faces[f][2]);
      blocks[f / extent_block].area += .5 * (b - a).cross(c - a).norm();
      blocks[f / extent_block].volume += (a - centre).dot((b - centre).cross(c - centre)) / 6;
    }
  });
  Sums all;
  for (const Sums& of_block : blocks) {
    all.area += of_block.area;
    all.volume += of_block.volume;
  }
  return all;
}

}  // namespace

Extent measure_extent(const Mat3X& points, const Adjacency& adjacency) {
  Extent extent;
  if (adjacency.faces.empty()) return extent;
  const Eigen::AlignedBox3d box = box_of_faces(points, adjacency.faces);
  extent.lower = box.min();
  extent.upper = box.max();
  extent.diagonal = box.diagonal().norm();
  const Vec3 centre = box.center();  // keeps the tetrahedra and their rounding small
  const Sums sums = sum_up(points, adjacency.faces, centre);
  extent.area = sums.area;
  const bool closed =
      std::ranges::none_of(adjacency.edge_faces, [](const auto& sides) { return sides[1] < 0; });
  if (closed) extent.volume = sums.volume;
  return extent;
}

Eigen::AlignedBox3d box_of_faces(const Mat3X& points, const std::vector<Triangle>& faces) {
  Eigen::AlignedBox3d box;
  for (const Triangle& t : faces)
    for (int v : t) box.extend(Vec3(points.col(v)));
  return box;
}

double total_area(const Mat3X& points, const std::vector<Triangle>& faces) {
  return parallel_sum(faces.size(), extent_block, [&](size_t begin, size_t end) {
    double sum = 0;
    for (size_t f = begin; f < end; ++f) sum += face_area(points, faces[f]);
    return sum;
  });
}

double box_diagonal(const Mat3X& points) {
  if (points.cols() == 0) return 0;
  return (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).stableNorm();
}

}  // namespace hooke
