#include "hooke/mesh/principal_curvature.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>

#include "hooke/core/parallel.h"
#include "hooke/mesh/normals.h"

namespace hooke {
namespace {

constexpr size_t enough = 9;  // vertices for the six coefficients, with some to spare against noise
constexpr double any_side = -2;
constexpr double same_sheet = .2;  // least cosine of a normal with the axis

/// Mean normal of the vertex and its neighbours: their majority stands where one ring is folded.
Vec3 axis_at(const Connectivity& c, const Mat3X& normals, int vertex) {
  Vec3 sum = normals.col(vertex);
  for (int w : c.vertex_neighbours[vertex]) sum += normals.col(w);
  return sum.normalized();
}

/// The vertices within some rings of `centre`, which comes first, whose normals lean at most so far from the
/// axis.
std::vector<int> neighbourhood(const Connectivity& c, const Mat3X& normals, int centre, const Vec3& axis,
                               double least_cosine) {
  std::vector<int> found = {centre};
  size_t ring_begin = 0;
  for (int ring = 1; ring <= 2 || (ring == 3 && found.size() <= enough); ++ring) {
    const size_t ring_end = found.size();
    for (; ring_begin < ring_end; ++ring_begin)
      for (int w : c.vertex_neighbours[found[ring_begin]])
        if (normals.col(w).dot(axis) >= least_cosine && std::ranges::find(found, w) == found.end())
          found.push_back(w);
  }
  return found;
}

/// Largest eigenvalue by size of the shape operator of z = f0 + d x + e y + (a x^2 + 2 b x y + c y^2) / 2.
double largest_curvature(double a, double b, double c, double d, double e) {
  Eigen::Matrix2d first, second;
  first << 1 + d * d, d * e, d * e, 1 + e * e;
  second << a, b, b, c;
  second /= std::sqrt(1 + d * d + e * e);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> shape(second, first,
                                                                        Eigen::EigenvaluesOnly);
  return shape.eigenvalues().cwiseAbs().maxCoeff();
}

double fit_curvature(const Mat3X& points, const Vec3& n, const std::vector<int>& vertices) {
  const Vec3 origin = points.col(vertices[0]);
  double radius = 0;
  for (int v : vertices) radius = std::max(radius, (points.col(v) - origin).norm());
  if (!(radius > 0)) return 0;
  // Leaning on an edge, not on a coordinate axis, so that a turned mesh has the same fit.
  const Vec3 edge = points.col(vertices[1]) - origin;
  const Vec3 u = (edge - n * n.dot(edge)).normalized(), v = n.cross(u);

  const auto rows = static_cast<Eigen::Index>(vertices.size());
  Eigen::Matrix<double, Eigen::Dynamic, 6> monomials(rows, 6);
  Eigen::VectorXd height(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Vec3 p = (points.col(vertices[static_cast<size_t>(i)]) - origin) / radius;
    const double x = u.dot(p), y = v.dot(p);
    monomials.row(i) << 1, x, y, .5 * x * x, x * y, .5 * y * y;
    height[i] = n.dot(p);
  }
  // Of the least norm where the vertices do not settle all coefficients.
  const Eigen::Matrix<double, 6, 1> k = monomials.completeOrthogonalDecomposition().solve(height);
  return largest_curvature(k[3], k[4], k[5], k[1], k[2]) / radius;
}

}  // namespace

std::vector<double> largest_curvatures(const Mat3X& points, const Connectivity& c) {
  const Mat3X normals = vertex_normals(points, c);
  std::vector<double> curvature(static_cast<size_t>(c.vertex_count), 0);
  parallel_for(curvature.size(), 256, [&](size_t begin, size_t end) {
    for (size_t v = begin; v < end; ++v) {
      const int centre = static_cast<int>(v);
      const Vec3 axis = axis_at(c, normals, centre);
      std::vector<int> vertices = neighbourhood(c, normals, centre, axis, same_sheet);
      if (vertices.size() <= enough) vertices = neighbourhood(c, normals, centre, axis, any_side);
      if (vertices.size() > 1) curvature[v] = fit_curvature(points, axis, vertices);
    }
  });
  return curvature;
}

}  // namespace hooke
