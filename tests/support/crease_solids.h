// Solids with sharp edges and irregular triangles, for tests.
#pragma once

#include <functional>
#include <map>
#include <numbers>
#include <set>

#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/normals.h"
#include "support/solids.h"

namespace hooke::test {

/// The surface of the unit cells that `filled` names, two triangles a square. Points are shifted by up to
/// `jitter` along the planes and edges that they lie on, so the solid stays exactly what it is.
inline Triangles cells(int nx, int ny, int nz, const std::function<bool(int, int, int)>& filled,
                       double jitter = .3, unsigned seed = 1) {
  using Cell = std::array<int, 3>;
  const auto is_filled = [&](const Cell& c) {
    return c[0] >= 0 && c[1] >= 0 && c[2] >= 0 && c[0] < nx && c[1] < ny && c[2] < nz &&
           filled(c[0], c[1], c[2]);
  };
  std::map<Cell, int> ids;
  std::vector<std::set<size_t>> normals;  // axes of the squares at each point
  Triangles t;
  const auto add_square = [&](const Cell& cell, size_t axis, int side) {
    const size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::array<int, 4> q{};
    for (size_t i = 0; i < 4; ++i) {
      Cell p = cell;
      p[axis] += side;
      p[u] += i == 1 || i == 2;
      p[v] += i >= 2;
      q[i] = ids.try_emplace(p, static_cast<int>(ids.size())).first->second;
      normals.resize(ids.size());
      normals[q[i]].insert(axis);
    }
    if (side == 0) std::swap(q[1], q[3]);
    t.faces.push_back({q[0], q[1], q[2]});
    t.faces.push_back({q[0], q[2], q[3]});
  };
  for (int x = 0; x < nx; ++x)
    for (int y = 0; y < ny; ++y)
      for (int z = 0; z < nz; ++z)
        for (size_t axis = 0; axis < 3; ++axis)
          for (int side : {0, 1}) {
            Cell next = {x, y, z};
            next[axis] += side == 0 ? -1 : 1;
            if (is_filled({x, y, z}) && !is_filled(next)) add_square({x, y, z}, axis, side);
          }
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-jitter, jitter);
  t.points.resize(3, static_cast<Eigen::Index>(ids.size()));
  for (const auto& [cell, id] : ids)
    for (size_t axis = 0; axis < 3; ++axis)
      t.points(static_cast<Eigen::Index>(axis), id) =
          cell[axis] + (normals[id].contains(axis) ? 0 : shift(random));
  return t;
}

/// [0, n]^3
inline Triangles irregular_cube(int n, unsigned seed = 1) {
  return cells(
      n, n, n, [](int, int, int) { return true; }, .3, seed);
}

/// A box around the origin, half so large as `half`, with edges that are rounded by the radius in 2 `steps`
/// facets, and no vertices within its flat sides.
inline Triangles rounded_box(const Vec3& half, double radius, int steps) {
  const int n = 2 * steps + 1;
  Triangles t = cells(
      n, n, n, [](int, int, int) { return true; }, 0);
  for (auto x : t.points.colwise()) {
    Vec3 centre, direction;
    for (int k = 0; k < 3; ++k) {
      const bool is_low = x[k] <= steps;
      const double turn = (is_low ? x[k] - steps : x[k] - steps - 1) / steps;  // -1 to 1
      centre[k] = (is_low ? -1 : 1) * (half[k] - radius);
      direction[k] = std::tan(turn * std::numbers::pi / 4);
    }
    x = centre + radius * direction.normalized();
  }
  return t;
}

/// A block of 2 m x m x 2 m with one quarter missing: a step.
inline Triangles step_block(int m) {
  return cells(2 * m, m, 2 * m, [m](int x, int, int z) { return x < m || z < m; });
}

/// Radius 1, z from 0 to 2, `around` points on each circular edge.
inline Triangles cylinder(int around, double jitter = .3, unsigned seed = 2) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-jitter, jitter);
  const double step = 2 * std::numbers::pi / around;
  const int rows = std::max(2, static_cast<int>(std::lround(2 / step)));
  const int rings = std::max(2, static_cast<int>(std::lround(1 / step)));
  std::vector<Vec3> p;
  Triangles t;
  const auto vertex = [around](int row, int i) { return row * around + i % around; };
  const auto join = [&](int low, int high) {
    for (int i = 0; i < around; ++i) {
      t.faces.push_back({vertex(low, i), vertex(low, i + 1), vertex(high, i + 1)});
      t.faces.push_back({vertex(low, i), vertex(high, i + 1), vertex(high, i)});
    }
  };
  // From the middle of the bottom out, up the side, and in to the middle of the top.
  const auto add_ring = [&](double radius, double z, double along, double across) {
    for (int i = 0; i < around; ++i) {
      const double angle = step * (i + along * shift(random)), out = across * shift(random) / rings;
      p.emplace_back((radius - out) * std::cos(angle), (radius - out) * std::sin(angle), z);
      if (radius == 1 && z > 0 && z < 2) p.back()[2] += 2 * shift(random) / rows;
    }
  };
  const auto radius = [&](int ring) { return double(ring) / rings; };
  for (int r = 1; r < rings; ++r) add_ring(radius(r), 0, 1, 1);
  for (int r = 0; r <= rows; ++r) add_ring(1, 2. * r / rows, 1, 0);
  for (int r = rings - 1; r > 0; --r) add_ring(radius(r), 2, 1, 1);
  const int rows_in_all = static_cast<int>(p.size()) / around;
  for (int r = 0; r + 1 < rows_in_all; ++r) join(r, r + 1);
  const int bottom = static_cast<int>(p.size()), top = bottom + 1;
  p.emplace_back(0, 0, 0);
  p.emplace_back(0, 0, 2);
  for (int i = 0; i < around; ++i) {
    t.faces.push_back({bottom, vertex(0, i + 1), vertex(0, i)});
    t.faces.push_back({top, vertex(rows_in_all - 1, i), vertex(rows_in_all - 1, i + 1)});
  }
  t.points.resize(3, static_cast<Eigen::Index>(p.size()));
  for (size_t v = 0; v < p.size(); ++v) t.points.col(static_cast<Eigen::Index>(v)) = p[v];
  return t;
}

/// The edges between faces that meet at more than 60 degrees.
inline std::vector<Edge> bent_edges(const Mat3X& X, const std::vector<Triangle>& faces) {
  const Adjacency c = make_adjacency(static_cast<int>(X.cols()), faces);
  const Mat3X normals = face_normals(X, c);
  std::vector<Edge> edges;
  for (size_t e = 0; e < c.edges.size(); ++e)
    if (normals.col(c.edge_faces[e][0]).dot(normals.col(c.edge_faces[e][1])) < .5)
      edges.push_back(c.edges[e]);
  return edges;
}

/// A pyramid over a regular polygon, its sides cut from the apex; a cone if it has many.
inline Triangles pyramid(int sides, double radius, double height) {
  Triangles t;
  t.points.resize(3, sides + 2);
  for (int i = 0; i < sides; ++i) {
    const double a = 2 * std::numbers::pi * i / sides;
    t.points.col(i) = Vec3(radius * std::cos(a), radius * std::sin(a), 0);
    t.faces.push_back({i, (i + 1) % sides, sides});
    t.faces.push_back({(i + 1) % sides, i, sides + 1});
  }
  t.points.col(sides) = Vec3(0, 0, height);
  t.points.col(sides + 1) = Vec3::Zero();
  return t;
}

/// A round body in rows of `around` vertices at these heights, each row in the gaps of the one below, with
/// fans of triangles at both ends: coarse, as drawing programs write cones without a tip or obliquely cut
/// bars.
inline Triangles rows_of_facets(int around, const std::vector<double>& heights,
                                const std::function<Vec3(double turn, double height)>& at) {
  Triangles t{Mat3X(3, around * std::ssize(heights) + 2), {}};
  const auto id = [around](size_t row, int i) { return static_cast<int>(row) * around + i % around; };
  for (size_t r = 0; r < heights.size(); ++r)
    for (int i = 0; i < around; ++i) {
      const double turn = 2 * std::numbers::pi * (i + .5 * static_cast<double>(r % 2)) / around;
      t.points.col(id(r, i)) = at(turn, heights[r]);
    }
  const auto bottom = static_cast<int>(t.points.cols()) - 2, top = bottom + 1;
  const size_t last = heights.size() - 1;
  t.points.col(bottom) = t.points.leftCols(around).rowwise().mean();
  t.points.col(top) = t.points.middleCols(id(last, 0), around).rowwise().mean();
  for (int i = 0; i < around; ++i) {
    t.faces.push_back({bottom, id(0, i + 1), id(0, i)});
    t.faces.push_back({top, id(last, i), id(last, i + 1)});
    for (size_t r = 0; r < last; ++r) {
      const int shift = static_cast<int>(r % 2);
      t.faces.push_back({id(r, i), id(r, i + 1), id(r + 1, i + shift)});
      t.faces.push_back({id(r, i + 1 - shift), id(r + 1, i + 1), id(r + 1, i)});
    }
  }
  return t;
}

}  // namespace hooke::test
