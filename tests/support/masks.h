// Surfaces that marching tetrahedra and cubes make, as of binary masks. For tests.
#pragma once

#include <algorithm>
#include <array>
#include <map>

#include "support/solids.h"

namespace hooke::test {

/// The surface where a function is 0, which is less inside: marching tetrahedra on a grid of edge 1, six to a
/// cell, whose faces cut the edges where the function is 0 between their ends, but not closer than .01 to
/// them. Points beyond `size` are not looked at.
template <typename Value>
Triangles marched_level(int size, const Value& value) {
  using Point = std::array<int, 3>;
  std::map<Point, int> ids;  // by twice the coordinates
  Triangles t;
  std::vector<Vec3> points;
  const auto value_at = [&](const Point& p) -> double { return value(Vec3(p[0], p[1], p[2])); };
  const auto cut = [&](const Point& a, const Point& b) {
    const Point doubled = {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
    const auto [at, is_new] = ids.try_emplace(doubled, static_cast<int>(points.size()));
    if (is_new) {
      const double share = std::clamp(value_at(a) / (value_at(a) - value_at(b)), .01, .99);
      points.push_back(Vec3(a[0], a[1], a[2]) + share * Vec3(b[0] - a[0], b[1] - a[1], b[2] - a[2]));
    }
    return at->second;
  };
  const auto add = [&](Triangle face, const Vec3& outwards) {
    const Vec3 a = points[face[0]];
    if ((points[face[1]] - a).cross(points[face[2]] - a).dot(outwards) < 0) std::swap(face[1], face[2]);
    t.faces.push_back(face);
  };
  const auto march = [&](const std::array<Point, 4>& corners) {
    std::vector<Point> in, out;
    Vec3 outwards = Vec3::Zero();
    for (const Point& p : corners) (value_at(p) < 0 ? in : out).push_back(p);
    if (in.empty() || out.empty()) return;
    for (const Point& p : out) outwards += Vec3(p[0], p[1], p[2]) / static_cast<double>(out.size());
    for (const Point& p : in) outwards -= Vec3(p[0], p[1], p[2]) / static_cast<double>(in.size());
    if (in.size() == 1) return add({cut(in[0], out[0]), cut(in[0], out[1]), cut(in[0], out[2])}, outwards);
    if (out.size() == 1) return add({cut(in[0], out[0]), cut(in[1], out[0]), cut(in[2], out[0])}, outwards);
    const std::array<int, 4> quad = {cut(in[0], out[0]), cut(in[0], out[1]), cut(in[1], out[1]),
                                     cut(in[1], out[0])};
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

/// The same between the points of the grid that are inside, and the others: edges are cut in the middle.
template <typename IsInside>
Triangles marched_mask(int size, const IsInside& is_inside) {
  return marched_level(size, [&](const Vec3& x) { return is_inside(x) ? -1 : 1; });
}

/// The surface where a function is 0, which is less inside: marching cubes on a grid of edge 1. Points beyond
/// `size` are not looked at. Where corners of a side of a cell are inside by turns, these are joined.
template <typename Value>
Triangles marched_cubes(int size, const Value& value) {
  using Point = std::array<int, 3>;
  std::map<std::array<Point, 2>, int> ids;  // of the vertices, by the ends of the edge, the inner one first
  std::vector<Vec3> points;
  const auto value_at = [&](const Point& p) -> double { return value(Vec3(p[0], p[1], p[2])); };
  const auto cut = [&](const Point& in, const Point& out) {
    const auto [at, is_new] = ids.try_emplace({in, out}, static_cast<int>(points.size()));
    if (is_new) {
      const double share = value_at(in) / (value_at(in) - value_at(out));
      points.push_back(Vec3(in[0], in[1], in[2]) +
                       share * Vec3(out[0] - in[0], out[1] - in[1], out[2] - in[2]));
    }
    return at->second;
  };
  Triangles t;
  const auto march = [&](const Point& cell) {
    std::map<int, int> next;  // vertex around the part inside
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (int side : {0, 1}) {
        std::array<Point, 4> corners;  // of the side of the cell, around it as seen from outside
        for (std::size_t k = 0; k < 4; ++k) {
          Point& corner = corners[side == 1 ? k : 3 - k];
          corner = cell;
          corner[axis] += side;
          corner[(axis + 1) % 3] += k == 1 || k == 2;
          corner[(axis + 2) % 3] += k >= 2;
        }
        const auto is_inside = [&](std::size_t k) { return value_at(corners[k % 4]) < 0; };
        for (std::size_t k = 0; k < 4; ++k) {
          if (!is_inside(k) || is_inside(k + 1)) continue;
          std::size_t last = k + 1;  // of the corners outside
          while (!is_inside(last + 1)) ++last;
          next[cut(corners[(last + 1) % 4], corners[last % 4])] = cut(corners[k], corners[(k + 1) % 4]);
        }
      }
    while (!next.empty()) {
      std::vector<int> loop = {next.begin()->first};
      for (auto at = next.begin(); at != next.end(); at = next.find(loop.back())) {
        if (at->second != loop.front()) loop.push_back(at->second);
        next.erase(at);
      }
      for (std::size_t k = 2; k < loop.size(); ++k) t.faces.push_back({loop[0], loop[k - 1], loop[k]});
    }
  };
  for (int x = -size; x < size; ++x)
    for (int y = -size; y < size; ++y)
      for (int z = -size; z < size; ++z) march({x, y, z});
  t.points.resize(3, std::ssize(points));
  for (Eigen::Index v = 0; v < t.points.cols(); ++v) t.points.col(v) = points[v];
  return t;
}

}  // namespace hooke::test
