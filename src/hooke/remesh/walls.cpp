#include "hooke/remesh/walls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "hooke/core/parallel.h"
#include "hooke/measure/measured_surface.h"
#include "hooke/mesh/mesh.h"
#include "hooke/mesh/normals.h"
#include "hooke/remesh/attempts.h"

namespace hooke {
namespace {

constexpr double least_thickness = 1e-4;                     // of the diagonal
constexpr double opposite_cosine = std::numbers::sqrt3 / 2;  // of 30 degrees

/// The distance from x, on a face with this normal, to the face of the surface across a wall or a gap that is
/// closest, if it is within `reach`; else infinite.
double thickness_at(const Vec3& x, const Vec3& normal, const AabbTree& tree, const Mat3X& normals,
                    double reach) {
  const auto is_opposite = [&](int f) { return normals.col(f).dot(normal) < -opposite_cosine; };
  ClosestPoint within;
  within.squared_distance = reach * reach;
  const ClosestPoint other = tree.closest(x, is_opposite, within);
  if (other.face < 0) return std::numeric_limits<double>::infinity();
  const double distance = std::sqrt(other.squared_distance);
  const bool is_straight = std::abs((other.point - x).dot(normal)) > opposite_cosine * distance;
  return is_straight ? distance : std::numeric_limits<double>::infinity();
}

Vec3 longest_edge(const std::array<Vec3, 3>& corners) {
  const std::array<Vec3, 3> edges{corners[1] - corners[0], corners[2] - corners[1], corners[0] - corners[2]};
  return *std::ranges::max_element(edges, {}, [](const Vec3& edge) { return edge.squaredNorm(); });
}

}  // namespace

std::vector<LeftWall> left_walls(const AttemptMaker& maker, const Attempt& attempt, double share) {
  constexpr size_t block = 256;
  const MeasuredSurface &input = maker.input(), result = maker.surface_of(attempt);
  const std::vector<Triangle>& faces = input.adjacency.faces;
  const double least = least_thickness * input.extent.diagonal;
  const Mat3X normals = certain_face_normals(input.points, input.adjacency);
  const std::vector<double> lengths =
      attempt.result.memory_order.order.gather(vertex_values(attempt.mesh, target_length_property));
  std::vector<LeftWall> walls(faces.size());
  parallel_for(faces.size(), block, [&](size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) {
      const auto& [a, b, c] = faces[f];
      const std::array<Vec3, 3> corners{input.points.col(a), input.points.col(b), input.points.col(c)};
      const Vec3 x = (corners[0] + corners[1] + corners[2]) / 3,
                 normal = normals.col(static_cast<Eigen::Index>(f));
      const ClosestPoint closest = result.tree.closest(x);
      const double distance = std::abs((closest.point - x).dot(normal));
      if (closest.face < 0 || !(distance > share * least)) continue;
      const double thickness = thickness_at(x, normal, input.tree, normals, distance / share);
      if (!std::isfinite(thickness) || thickness < least) continue;
      double target = std::numeric_limits<double>::infinity();
      for (int v : result.adjacency.faces[closest.face]) target = std::min(target, lengths[v]);
      const Vec3 along = longest_edge(corners) / 3;
      walls[f] = {x - along, x + along, distance, thickness, target};
    }
  });
  std::erase_if(walls, [](const LeftWall& wall) { return wall.thickness == 0; });
  return walls;
}

void note_walls(const AttemptMaker& maker, Attempt& attempt) {
  constexpr double much = .25;  // of the thickness
  RemeshResult& result = attempt.result;
  if (!result.measures || !maker.has_facets() || maker.smooths_mask() || attempt.is_interrupted() ||
      result.rescue == Rescue::put_back)
    return;
  const std::vector<LeftWall> walls = left_walls(maker, attempt, much);
  if (walls.empty()) return;
  const auto lost_share = [](const LeftWall& wall) { return wall.distance / wall.thickness; };
  const LeftWall& worst = *std::ranges::max_element(walls, {}, lost_share);
  result.left_walls = static_cast<int>(walls.size());
  result.thickness = worst.thickness;
  result.lost_thickness = worst.distance;
  result.thin_place = .5 * (worst.from + worst.to);
}

}  // namespace hooke
