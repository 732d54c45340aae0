// Meshes built in code, for tests. All are consistently oriented, outside up or outward.
#pragma once

#include <vector>

#include "hooke/mesh/mesh.h"

namespace hooke::test {

struct Triangles {
  Mat3X points;
  std::vector<Triangle> faces;
};

/// (n + 1)^2 points of the unit square at z = height(x, y), 2 n^2 triangles. Inner points are moved in x and
/// y by up to `jitter` cells, drawn from `seed`.
Triangles grid(int n, double (*height)(double x, double y), double jitter = 0, unsigned seed = 1);

/// Icosahedron subdivided `levels` times on the unit sphere: 10 * 4^levels + 2 points. Each point is moved
/// along the sphere by up to `jitter` edge lengths.
Triangles sphere(int levels, double jitter = 0, unsigned seed = 1);

inline TriMesh to_mesh(const Triangles& t) {
  return build_mesh(t.points, t.faces);
}
inline double flat(double, double) {
  return 0;
}
inline double paraboloid(double x, double y) {
  return .5 * (x * x + y * y);
}

}  // namespace hooke::test
