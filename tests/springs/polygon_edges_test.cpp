#include "hooke/springs/polygon_edges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "hooke/core/error.h"
#include "hooke/geometry/triangle.h"
#include "hooke/remesh/preserving_remesh.h"
#include "hooke/springs/sizing.h"
#include "support/meshes.h"

namespace hooke {
namespace {

/// A mesh of polygons, each cut as a fan from its first corner.
struct Polygons {
  Mat3X points;
  IntLists corners{{0}, {}};
  std::vector<Triangle> triangles = {};

  void add(const std::vector<int>& polygon) {
    corners.items.insert(corners.items.end(), polygon.begin(), polygon.end());
    corners.first.push_back(static_cast<int>(corners.items.size()));
    for (std::size_t k = 2; k < polygon.size(); ++k)
      triangles.push_back({polygon[0], polygon[k - 1], polygon[k]});
  }
};

Polygons regular_polygon(int n) {
  Polygons p{Mat3X(3, n)};
  std::vector<int> corners(n);
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * k / n;
    p.points.col(k) = Vec3(std::cos(angle), std::sin(angle), 0);
    corners[k] = k;
  }
  p.add(corners);
  return p;
}

/// n x n squares of side 1, their inner corners sheared and moved at random.
Polygons sheared_sheet(int n, double shear, double noise) {
  Polygons p{Mat3X(3, (n + 1) * (n + 1))};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> move(-noise, noise);
  const auto id = [&](int i, int j) { return i * (n + 1) + j; };
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      const bool is_inner = i > 0 && j > 0 && i < n && j < n;
      const double bulge = shear * std::sin(std::numbers::pi * i / n) * std::sin(std::numbers::pi * j / n);
      p.points.col(id(i, j)) =
          Vec3(i + bulge + (is_inner ? move(random) : 0), j + (is_inner ? move(random) : 0), 0);
    }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) p.add({id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)});
  return p;
}

/// The ratios of all edges, by the lengths of the edges in a mesh of regular polygons.
void expect_ratios_of_lengths(const Polygons& p) {
  const MemoryOrder memory_order = find_memory_order(static_cast<int>(p.points.cols()), p.triangles);
  const std::vector<double> ratios = rest_ratios(p.corners, memory_order);
  const Adjacency& c = *memory_order.adjacency;
  const Mat3X points = memory_order.order.gather(p.points);
  double area = 0;
  for (const Triangle& t : c.faces) area += face_shape(points, t).area;
  const double length = natural_length(area, c.faces.size());
  for (std::size_t e = 0; e < ratios.size(); ++e) {
    const auto [v, w] = c.edges[e];
    EXPECT_NEAR(ratios[e], (points.col(v) - points.col(w)).norm() / length, 1e-12);
  }
}

TEST(RestRatios, AreThoseOfEquilateralTrianglesAndSquaresThatCoverTheArea) {
  expect_ratios_of_lengths(regular_polygon(3));
  expect_ratios_of_lengths(sheared_sheet(3, 0, 0));
  Polygons house = regular_polygon(4);
  house.points.conservativeResize(3, 5);
  house.points.col(4) = Vec3(1, 1, 0) / 2 + Vec3(1, 1, 0).normalized() * std::sqrt(1.5);
  house.add({1, 0, 4});
  expect_ratios_of_lengths(house);
}

TEST(RestRatios, AreEqualInOtherPolygons) {
  for (const int n : {5, 7}) {
    const Polygons p = regular_polygon(n);
    for (double ratio : rest_ratios(p.corners, find_memory_order(n, p.triangles))) EXPECT_DOUBLE_EQ(ratio, 1);
  }
}

TEST(RestRatios, MustBeOfThePolygonsOfTheMesh) {
  const Polygons p = regular_polygon(5);
  EXPECT_THROW(rest_ratios(p.corners, find_memory_order(4, {{0, 1, 2}, {0, 2, 3}})), Error);
}

/// The mean deviation of the corners of quadrilaterals from 90 degrees.
double mean_deviation(const Polygons& p, const Mat3X& points) {
  double sum = 0;
  for (int f = 0; f + 1 < std::ssize(p.corners.first); ++f)
    for (std::size_t k = 0; k < 4; ++k) {
      const auto at = [&](std::size_t i) -> Vec3 { return points.col(p.corners[f][i % 4]); };
      const Vec3 a = at(k + 1) - at(k), b = at(k + 3) - at(k);
      sum += std::abs(std::acos(a.dot(b) / (a.norm() * b.norm())) * 180 / std::numbers::pi - 90);
    }
  return sum / static_cast<double>(p.corners.items.size());
}

TEST(RestRatios, MakeSquaresOfQuadrilaterals) {
  const Polygons p = sheared_sheet(12, 3, .2);
  TriMesh mesh = build_mesh(p.points, p.triangles);
  const MemoryOrder memory_order = find_memory_order(mesh);
  set_target_lengths(mesh, memory_order);
  TriMesh as_triangles = mesh;
  set_edge_values(mesh, rest_ratio_property, memory_order.order, *memory_order.adjacency,
                  rest_ratios(p.corners, memory_order));
  EXPECT_EQ(preserving_remesh(mesh, memory_order, {}).measures->preservation.flaws(), 0);
  preserving_remesh(as_triangles, memory_order, {});
  const double before = mean_deviation(p, p.points), squares = mean_deviation(p, vertex_points(mesh));
  EXPECT_LT(squares, .6 * before);
  EXPECT_LT(squares, .6 * mean_deviation(p, vertex_points(as_triangles)));
}

TEST(RestRatios, AreForFixedFacesOnly) {
  const Polygons p = sheared_sheet(3, 0, .2);
  TriMesh mesh = build_mesh(p.points, p.triangles);
  const MemoryOrder memory_order = find_memory_order(mesh);
  set_target_lengths(mesh, memory_order);
  set_edge_values(mesh, rest_ratio_property, memory_order.order, *memory_order.adjacency,
                  rest_ratios(p.corners, memory_order));
  RemeshOptions options;
  options.connectivity = ConnectivityMode::flip;
  EXPECT_THROW(preserving_remesh(mesh, memory_order, options), Error);
}

}  // namespace
}  // namespace hooke
