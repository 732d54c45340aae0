// Surfaces of binary masks. For tests.
#pragma once

#include <array>
#include <map>

#include "support/solids.h"

namespace hooke::test {

/// The surface between the points of a grid of edge 1 that are inside, and the others: marching tetrahedra,
/// six to a cell, whose faces cut the edges in the middle. Points beyond `size` are not inside.
template <typename IsInside>
Triangles marched_mask(int size, const IsInside& is_inside) {
  using Point = std::array<int, 3>;
  std::map<Point, int> ids;  // by twice the coordinates
  Triangles t;
  std::vector<Vec3> points;
  const auto middle = [&](const Point& a, const Point& b) {
    const Point doubled = {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
    const auto [at, is_new] = ids.try_emplace(doubled, static_cast<int>(points.size()));
    if (is_new) points.push_back(.5 * Vec3(doubled[0], doubled[1], doubled[2]));
    return at->second;
  };
  const auto inside = [&](const Point& p) { return is_inside(Vec3(p[0], p[1], p[2])); };
  const auto add = [&](Triangle face, const Vec3& outwards) {
    const Vec3 a = points[face[0]];
    if ((points[face[1]] - a).cross(points[face[2]] - a).dot(outwards) < 0) std::swap(face[1], face[2]);
    t.faces.push_back(face);
  };
  const auto march = [&](const std::array<Point, 4>& corners) {
    std::vector<Point> in, out;
    Vec3 outwards = Vec3::Zero();
    for (const Point& p : corners) (inside(p) ? in : out).push_back(p);
    if (in.empty() || out.empty()) return;
    for (const Point& p : out) outwards += Vec3(p[0], p[1], p[2]) / static_cast<double>(out.size());
    for (const Point& p : in) outwards -= Vec3(p[0], p[1], p[2]) / static_cast<double>(in.size());
    if (in.size() == 1)
      return add({middle(in[0], out[0]), middle(in[0], out[1]), middle(in[0], out[2])}, outwards);
    if (out.size() == 1)
      return add({middle(in[0], out[0]), middle(in[1], out[0]), middle(in[2], out[0])}, outwards);
    const std::array<int, 4> quad = {middle(in[0], out[0]), middle(in[0], out[1]), middle(in[1], out[1]),
                                     middle(in[1], out[0])};
    add({quad[0], quad[1], quad[2]}, outwards);
    add({quad[0], quad[2], quad[3]}, outwards);
  };
  std::array<std::size_t, 3> axes = {0, 1, 2};
  for (int x = -size; x < size; ++x)
    for (int y = -size; y < size; ++y)
      for (int z = -size; z < size; ++z) do {
          std::array<Point, 4> corners;
          corners.fill({x, y, z});
          for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t later = k + 1; later < 4; ++later) ++corners[later][axes[k]];
          march(corners);
        } while (std::ranges::next_permutation(axes).found);
  t.points.resize(3, std::ssize(points));
  for (Eigen::Index v = 0; v < t.points.cols(); ++v) t.points.col(v) = points[v];
  return t;
}

}  // namespace hooke::test
