#include "hooke/filter/field_reach.h"

#include <algorithm>
#include <limits>

#include "hooke/core/parallel.h"

namespace hooke {

constexpr float no_limit = std::numeric_limits<float>::infinity();

std::vector<float> reaches_of(const NearFaces& faces, double reach, const std::vector<double>& lengths) {
  constexpr double bending = 4;
  const auto& [points, normals, connectivity] = faces;
  std::vector<float> reaches;
  if (reach == std::numeric_limits<double>::infinity()) return reaches;
  const auto most = [&](int v) {
    return lengths.empty() ? reach : reach * lengths[static_cast<std::size_t>(v)];
  };
  std::vector<char> bends(connectivity.edges.size());
  parallel_for(bends.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const auto& [a, b] = connectivity.edges[e];
      const double sagitta =
          (normals.col(a) - normals.col(b)).norm() * (points.col(a) - points.col(b)).norm() / 8;
      bends[e] = bending * sagitta > std::min(most(a), most(b));
    }
  });
  for (std::size_t e = 0; e < bends.size(); ++e) {
    if (!bends[e]) continue;
    reaches.resize(static_cast<std::size_t>(connectivity.vertex_count), no_limit);
    for (int end : connectivity.edges[e]) {
      reaches[static_cast<std::size_t>(end)] = static_cast<float>(most(end));
      for (int v : connectivity.vertex_neighbours[end])
        reaches[static_cast<std::size_t>(v)] = static_cast<float>(most(v));
    }
  }
  return reaches;
}

Foot within_reach(const NearFaces& faces, const std::vector<float>& reaches, const Vec3& x,
                  const Foot& foot) {
  if (reaches.empty()) return foot;
  const double reach = reaches[static_cast<std::size_t>(foot.anchor)];
  if (reach == no_limit || faces.has_face_within(foot.point, foot.anchor, reach)) return foot;
  Foot below = faces.closest_point(foot.point, foot.anchor);
  Vec3 height = foot.point - below.point;
  if (!(height.squaredNorm() > reach * reach)) return foot;

  const double side = height.dot(below.normal) < 0 ? -1 : 1;
  const Foot below_start = faces.closest_point(x, foot.anchor);
  const Vec3 start_height = x - below_start.point;
  if (side * start_height.dot(below_start.normal) > 0 && start_height.norm() > .5 * reach) {
    below = below_start;
    height = start_height;
  }
  height.normalize();
  return {below.point + reach * height, side * height, below.anchor, FootStatus::converged, foot.evaluations};
}

}  // namespace hooke
