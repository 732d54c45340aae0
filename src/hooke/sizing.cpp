#include "hooke/sizing.h"

#include <cmath>

#include "hooke/parallel.h"

namespace hooke {

double total_area(const Mat3X& points, const std::vector<Triangle>& faces) {
  return parallel_sum(faces.size(), 4096, [&](size_t begin, size_t end) {
    double sum = 0;
    for (size_t f = begin; f < end; ++f) {
      const Vec3 a = points.col(faces[f][0]);
      sum += .5 * (points.col(faces[f][1]) - a).cross(points.col(faces[f][2]) - a).norm();
    }
    return sum;
  });
}

double natural_length(double area, std::size_t face_count) {
  return std::sqrt(4 * area / (std::sqrt(3.) * static_cast<double>(face_count)));
}

TargetLengths spread_target_lengths(const Connectivity& c, const std::vector<double>& vertex_length) {
  TargetLengths targets;
  targets.edge.reserve(c.edges.size());
  for (const auto& [a, b] : c.edges)
    targets.edge.push_back(.5 *
                           (vertex_length[static_cast<size_t>(a)] + vertex_length[static_cast<size_t>(b)]));
  targets.face.reserve(c.faces.size());
  for (const auto& edges : c.face_edges) {
    double sum = 0;
    for (int e : edges) sum += targets.edge[static_cast<size_t>(e)];
    targets.face.push_back(sum / 3);
  }
  return targets;
}

}  // namespace hooke
