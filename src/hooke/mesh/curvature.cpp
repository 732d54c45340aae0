#include "hooke/mesh/curvature.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "hooke/core/parallel.h"
#include "hooke/mesh/normals.h"
#include "hooke/mesh/topology.h"
#include "hooke/mesh/wedges.h"

namespace hooke {
namespace {

/// Cotangent of the angle at `opposite_vertex`; negative when it is obtuse.
double cotangent_at(const Vec3& opposite_vertex, const Vec3& next, const Vec3& last, double twice_area) {
  return (next - opposite_vertex).dot(last - opposite_vertex) / twice_area;
}

/// Sum of angles between 0 and pi by multiplication of complex numbers, with one arc tangent for all.
class AngleSum {
 public:
  /// Adds the angle of (x, y), y > 0.
  void add(double x, double y) {
    const double u = x_ * x - y_ * y, v = x_ * y + y_ * x;
    const double size = std::abs(u) + std::abs(v);
    turns_ += y_ < 0 && v >= 0;
    x_ = u / size;
    y_ = v / size;
  }

  double value() const {
    const double angle = std::atan2(y_, x_);
    return 2 * std::numbers::pi * (turns_ + (angle < 0)) + angle;
  }

 private:
  double x_ = 1, y_ = 0;
  int turns_ = 0;
};

/// Sums over the faces around one vertex.
struct RingSums {
  Vec3 normal = Vec3::Zero();  // sum of (cot a + cot b) (x - x_j), Meyer et al. [8]
  AngleSum angle;
  double mixed_area = 0;  // Meyer et al., figure 4
  bool defined = true;
};

void add_face(const Vec3& p, const Vec3& q, const Vec3& r, RingSums& sums) {
  const double twice_area = (q - p).cross(r - p).norm();
  if (!(twice_area > 0)) {
    sums.defined = false;
    return;
  }
  const double cot_p = cotangent_at(p, q, r, twice_area);
  const double cot_q = cotangent_at(q, r, p, twice_area);
  const double cot_r = cotangent_at(r, p, q, twice_area);
  sums.normal += cot_r * (p - q) + cot_q * (p - r);
  sums.angle.add((q - p).dot(r - p), twice_area);
  if (cot_p < 0) {
    sums.mixed_area += twice_area / 4;
  } else if (cot_q < 0 || cot_r < 0) {
    sums.mixed_area += twice_area / 8;
  } else {  // the vertex's Voronoi cell, Meyer et al. [7]
    sums.mixed_area += (cot_r * (p - q).squaredNorm() + cot_q * (p - r).squaredNorm()) / 8;
  }
}

}  // namespace

VertexCurvature measure_curvature(const Mat3X& points, const Adjacency& adjacency) {
  const size_t n = adjacency.vertex_count;
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  VertexCurvature curvature{std::vector<double>(n, none), std::vector<double>(n, none)};
  const std::vector<char> on_boundary = boundary_vertices(adjacency);
  parallel_for(n, 1024, [&](size_t begin, size_t end) {
    for (size_t v = begin; v < end; ++v) {
      const auto ring = adjacency.vertex_faces[static_cast<int>(v)];
      if (on_boundary[v] || ring.empty()) continue;
      RingSums sums;
      for (int f : ring) {
        const Triangle& t = adjacency.faces[f];
        const size_t k = corner_of(t, static_cast<int>(v));
        add_face(points.col(t[k]), points.col(t[(k + 1) % 3]), points.col(t[(k + 2) % 3]), sums);
      }
      if (!sums.defined || !(sums.mixed_area > 0)) continue;
      curvature.mean[v] = sums.normal.norm() / (4 * sums.mixed_area);
      curvature.gaussian[v] = (2 * std::numbers::pi - sums.angle.value()) / sums.mixed_area;
    }
  });
  return curvature;
}

namespace {

constexpr size_t enough = 9;  // vertices for six coefficients, with a margin against noise
constexpr double any_side = -2;
constexpr double same_sheet = .2;  // minimum cosine of a normal with the axis

/// Mean normal of the vertex and its neighbours, robust where one ring is folded.
Vec3 axis_at(const Adjacency& c, const Mat3X& normals, int vertex) {
  Vec3 sum = normals.col(vertex);
  for (int w : c.vertex_neighbours[vertex]) sum += normals.col(w);
  return sum.normalized();
}

/// The vertices within two or three rings of `centre`, which comes first, whose normals have at least this
/// cosine with the axis.
std::vector<int> neighbourhood(const Adjacency& c, const Mat3X& normals, int centre, const Vec3& axis,
                               double min_cosine) {
  std::vector<int> found = {centre};
  size_t ring_begin = 0;
  for (int ring = 1; ring <= 2 || (ring == 3 && found.size() <= enough); ++ring) {
    const size_t ring_end = found.size();
    for (; ring_begin < ring_end; ++ring_begin)
      for (int w : c.vertex_neighbours[found[ring_begin]])
        if (normals.col(w).dot(axis) >= min_cosine && std::ranges::find(found, w) == found.end())
          found.push_back(w);
  }
  return found;
}

/// Eigenvalues of the shape operator of z = f0 + d x + e y + (a x^2 + 2 b x y + c y^2) / 2.
Eigen::Vector2d principal_curvatures(double a, double b, double c, double d, double e) {
  Eigen::Matrix2d first, second;
  first << 1 + d * d, d * e, d * e, 1 + e * e;
  second << a, b, b, c;
  second /= std::sqrt(1 + d * d + e * e);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> shape(second, first,
                                                                        Eigen::EigenvaluesOnly);
  return shape.eigenvalues();
}

Eigen::Vector2d fit_curvatures(const Mat3X& points, const Vec3& n, const std::vector<int>& vertices) {
  const Vec3 origin = points.col(vertices[0]);
  double radius = 0;
  for (int v : vertices) radius = std::max(radius, (points.col(v) - origin).norm());
  if (!(radius > 0)) return Eigen::Vector2d::Zero();
  // Aligned with an edge, not with a coordinate axis, so that a rotated mesh has the same fit.
  const Vec3 edge = points.col(vertices[1]) - origin;
  const Vec3 u = (edge - n * n.dot(edge)).normalized(), v = n.cross(u);

  const auto rows = static_cast<Eigen::Index>(vertices.size());
  Eigen::Matrix<double, Eigen::Dynamic, 6> monomials(rows, 6);
  Eigen::VectorXd height(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Vec3 p = (points.col(vertices[i]) - origin) / radius;
    const double x = u.dot(p), y = v.dot(p);
    monomials.row(i) << 1, x, y, .5 * x * x, x * y, .5 * y * y;
    height[i] = n.dot(p);
  }
  // Minimum-norm solution where the vertices do not determine all coefficients.
  const Eigen::Matrix<double, 6, 1> k = monomials.completeOrthogonalDecomposition().solve(height);
  return principal_curvatures(k[3], k[4], k[5], k[1], k[2]) / radius;
}

/// The principal curvatures at each vertex, zero at a vertex without faces.
Eigen::Matrix2Xd curvatures_of_pieces(const Mat3X& points, const Adjacency& c) {
  const Mat3X normals = vertex_normals(points, c);
  Eigen::Matrix2Xd curvatures = Eigen::Matrix2Xd::Zero(2, c.vertex_count);
  parallel_for(c.vertex_count, 256, [&](size_t begin, size_t end) {
    for (size_t v = begin; v < end; ++v) {
      const int centre = static_cast<int>(v);
      const Vec3 axis = axis_at(c, normals, centre);
      std::vector<int> vertices = neighbourhood(c, normals, centre, axis, same_sheet);
      if (vertices.size() <= enough) vertices = neighbourhood(c, normals, centre, axis, any_side);
      if (vertices.size() > 1) curvatures.col(centre) = fit_curvatures(points, axis, vertices);
    }
  });
  return curvatures;
}

/// The neighbours of each vertex along the boundary and the creases, -1 for those that are on no such curve,
/// and where curves meet, end, or turn by more than 60 degrees.
std::vector<std::array<int, 2>> neighbours_on_curves(const Mat3X& points, const Adjacency& c) {
  constexpr std::array<int, 2> none = {-1, -1};
  std::vector<std::array<int, 2>> neighbours(c.vertex_count, none);
  std::vector<int> count(neighbours.size(), 0);
  for (size_t e = 0; e < c.edges.size(); ++e) {
    if (!c.is_boundary_edge(static_cast<int>(e)) && !c.is_crease(static_cast<int>(e))) continue;
    for (size_t end : {0, 1}) {
      const size_t v = c.edges[e][end];
      if (count[v] < 2) neighbours[v][count[v]] = c.edges[e][1 - end];
      ++count[v];
    }
  }
  for (size_t v = 0; v < count.size(); ++v) {
    const auto& [a, b] = neighbours[v];
    if (count[v] == 2) {
      const Vec3 x = points.col(static_cast<Eigen::Index>(v));
      if ((x - points.col(a)).normalized().dot((points.col(b) - x).normalized()) > .5) continue;
    }
    neighbours[v] = none;
  }
  return neighbours;
}

/// The curvature of the boundary or crease at each vertex, by the circle through it and the second vertices
/// on both sides, so that a ragged curve is not a bent one; 0 where it is on none.
std::vector<double> curvatures_of_curves(const Mat3X& points, const Adjacency& c) {
  const std::vector<std::array<int, 2>> neighbours = neighbours_on_curves(points, c);
  const auto second = [&](int first, int v) {
    const auto& [a, b] = neighbours[first];
    return a < 0 ? first : a == v ? b : a;
  };
  std::vector<double> curvature(neighbours.size(), 0);
  for (size_t v = 0; v < neighbours.size(); ++v) {
    const auto& [a, b] = neighbours[v];
    if (a < 0) continue;
    const Vec3 x = points.col(static_cast<Eigen::Index>(v)), p = points.col(second(a, static_cast<int>(v))),
               q = points.col(second(b, static_cast<int>(v)));
    const double product = (p - x).norm() * (q - x).norm() * (q - p).norm();
    if (product > 0) curvature[v] = 2 * (p - x).cross(q - x).norm() / product;
  }
  return curvature;
}

}  // namespace

bool is_tip(const Mat3X& points, const Adjacency& c, int vertex) {
  constexpr double full_turn = 2 * std::numbers::pi, defect = 70 * std::numbers::pi / 180;
  const auto edges = c.vertex_edges[vertex];
  if (edges.empty() || std::ranges::any_of(edges, [&](int e) { return c.is_feature_edge(e); })) return false;
  double sum = 0;
  for (int f : c.vertex_faces[vertex]) {
    const Triangle& t = c.faces[f];
    const std::size_t k = corner_of(t, vertex);
    const Vec3 a = points.col(t[(k + 1) % 3]) - points.col(vertex),
               b = points.col(t[(k + 2) % 3]) - points.col(vertex);
    sum += std::atan2(a.cross(b).norm(), a.dot(b));
  }
  return sum < full_turn - defect;
}

std::vector<double> largest_curvatures(const Mat3X& points, const Adjacency& c) {
  std::vector<double> largest = curvatures_of_curves(points, c);
  const Eigen::Matrix2Xd of_wedges = curvatures_of_pieces(wedge_points(points, c), cut_open(c));
  for (int w = 0; w < c.wedge_count(); ++w) {
    double& l = largest[c.vertex_of_wedge(w)];
    l = std::max(l, of_wedges.col(w).cwiseAbs().maxCoeff());
  }
  return largest;
}

VertexCurvature fitted_curvature(const Mat3X& points, const Adjacency& c) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const size_t n = c.vertex_count;
  VertexCurvature curvature{std::vector<double>(n, none), std::vector<double>(n, none)};
  const Eigen::Matrix2Xd principal = curvatures_of_pieces(points, c);
  const std::vector<char> on_boundary = boundary_vertices(c);
  for (size_t v = 0; v < n; ++v) {
    if (on_boundary[v] || c.vertex_faces[static_cast<int>(v)].empty()) continue;
    const auto k = principal.col(static_cast<Eigen::Index>(v));
    curvature.mean[v] = std::abs(k.sum()) / 2;
    curvature.gaussian[v] = k.prod();
  }
  return curvature;
}

}  // namespace hooke
