// Sheets that meet in a line, for tests.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "hooke/mesh/junctions.h"
#include "hooke/mesh/repair.h"
#include "hooke/springs/sizing.h"
#include "support/meshes.h"

namespace hooke::test {

/// `count` strips of `rows` rows of faces, of this width, that meet in a polyline about along x.
inline Triangles fan(const Mat3X& line, int count, int rows, double width) {
  const int n = static_cast<int>(line.cols());
  Triangles t{Mat3X(3, n * (1 + count * rows)), {}};
  t.points.leftCols(n) = line;
  for (int s = 0; s < count; ++s) {
    const double turn = 2 * std::numbers::pi * s / count;
    const auto id = [&](int row, int i) { return row == 0 ? i : n * (1 + s * rows + row - 1) + i; };
    for (int row = 1; row <= rows; ++row)
      for (int i = 0; i < n; ++i)
        t.points.col(id(row, i)) = line.col(i) + width * row / rows * Vec3(0, std::cos(turn), std::sin(turn));
    for (int row = 0; row < rows; ++row)
      for (int i = 0; i + 1 < n; ++i) {
        t.faces.push_back({id(row, i), id(row, i + 1), id(row + 1, i)});
        t.faces.push_back({id(row, i + 1), id(row + 1, i + 1), id(row + 1, i)});
      }
  }
  return t;
}

/// Points of the x axis.
inline Mat3X on_axis(const std::vector<double>& x) {
  Mat3X line = Mat3X::Zero(3, std::ssize(x));
  for (std::size_t i = 0; i < x.size(); ++i) line(0, static_cast<Eigen::Index>(i)) = x[i];
  return line;
}

/// The sheets of a mesh with junctions, with v:joined and this target length.
inline TriMesh sheets(const Triangles& t, double length) {
  const Repaired r = repair(t.points, t.faces, {.keep_junctions = true}, {"m", {}, {}});
  TriMesh mesh = build_mesh(r.points, r.triangles);
  if (!r.origin.joined.empty()) set_joined_vertices(mesh, r.origin.joined);
  set_vertex_values(mesh, target_length_property, std::vector<double>(mesh.n_vertices(), length));
  return mesh;
}

}  // namespace hooke::test
