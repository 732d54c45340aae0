#include "hooke/springs/rest_ratios.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "hooke/core/error.h"
#include "hooke/geometry/triangle.h"
#include "hooke/measure/polygon_angles.h"
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

/// n x n rectangles of this size, their inner corners sheared and moved at random, by shares of the size.
Polygons sheared_sheet(int n, double shear, double noise, double width = 1) {
  Polygons p{Mat3X(3, (n + 1) * (n + 1))};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> move(-noise, noise);
  const auto id = [&](int i, int j) { return i * (n + 1) + j; };
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      const bool is_inner = i > 0 && j > 0 && i < n && j < n;
      const double bulge = shear * std::sin(std::numbers::pi * i / n) * std::sin(std::numbers::pi * j / n);
      p.points.col(id(i, j)) =
          Vec3(width * (i + bulge + (is_inner ? move(random) : 0)), j + (is_inner ? move(random) : 0), 0);
    }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) p.add({id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)});
  return p;
}

/// The ratios of a mesh of polygons, by edge of the adjacency.
std::vector<double> ratios_of(const Polygons& p, const MemoryOrder& memory_order) {
  const Adjacency& c = *memory_order.adjacency;
  const TargetLengths targets = spread_target_lengths(c, std::vector<double>(c.vertex_count, 3.));
  return rest_ratios(p.corners, memory_order, memory_order.order.gather(p.points), targets);
}

/// The lengths of the edges over that of as many equilateral triangles with the same area.
std::vector<double> relative_lengths(const Polygons& p, const MemoryOrder& memory_order) {
  const Adjacency& c = *memory_order.adjacency;
  const Mat3X points = memory_order.order.gather(p.points);
  double area = 0;
  for (const Triangle& t : c.faces) area += face_shape(points, t).area;
  std::vector<double> lengths;
  for (const auto& [v, w] : c.edges)
    lengths.push_back((points.col(v) - points.col(w)).norm() / natural_length(area, c.faces.size()));
  return lengths;
}

void expect_ratios_of_lengths(const Polygons& p) {
  const MemoryOrder memory_order = find_memory_order(static_cast<int>(p.points.cols()), p.triangles);
  const std::vector<double> ratios = ratios_of(p, memory_order), lengths = relative_lengths(p, memory_order);
  for (std::size_t e = 0; e < ratios.size(); ++e) EXPECT_NEAR(ratios[e], lengths[e], 1e-12);
}

TEST(RestRatios, AreTheLengthsOfRectanglesAndEquilateralTrianglesWhateverTheTargetLength) {
  expect_ratios_of_lengths(regular_polygon(3));
  expect_ratios_of_lengths(sheared_sheet(3, 0, 0));
  expect_ratios_of_lengths(sheared_sheet(3, 0, 0, 7));
  Polygons graded = sheared_sheet(9, 0, 0);
  graded.points = (.3 * graded.points.array()).exp();
  expect_ratios_of_lengths(graded);
  Polygons house = regular_polygon(4);
  house.points.conservativeResize(3, 5);
  house.points.col(4) = Vec3(1, 1, 0) / 2 + Vec3(1, 1, 0).normalized() * std::sqrt(1.5);
  house.add({1, 0, 4});
  expect_ratios_of_lengths(house);
}

TEST(RestRatios, AreEvenWhereLengthsAreNoisy) {
  const Polygons noisy = sheared_sheet(20, 0, .2, 3), even = sheared_sheet(20, 0, 0, 3);
  const MemoryOrder memory_order = find_memory_order(static_cast<int>(noisy.points.cols()), noisy.triangles);
  const std::vector<double> ratios = ratios_of(noisy, memory_order),
                            lengths = relative_lengths(noisy, memory_order),
                            wanted = ratios_of(even, memory_order);
  double error = 0, noise = 0;
  for (std::size_t e = 0; e < ratios.size(); ++e) {
    error += std::pow(ratios[e] / wanted[e] - 1, 2);
    noise += std::pow(lengths[e] / wanted[e] - 1, 2);
  }
  EXPECT_LT(std::sqrt(error), .4 * std::sqrt(noise));
}

TEST(RestRatios, AreOfSquaresWhereTargetLengthsVary) {
  const Polygons p = sheared_sheet(6, 0, .2, 3);
  const MemoryOrder memory_order = find_memory_order(static_cast<int>(p.points.cols()), p.triangles);
  const Adjacency& c = *memory_order.adjacency;
  std::vector<double> lengths(c.vertex_count, 1.);
  lengths[0] = 2;
  const std::vector<double> ratios = rest_ratios(p.corners, memory_order, memory_order.order.gather(p.points),
                                                 spread_target_lengths(c, lengths));
  const double side = std::ranges::min(ratios);
  for (double ratio : ratios)
    EXPECT_NEAR(ratio, ratio > 1.2 * side ? std::numbers::sqrt2 * side : side, 1e-12);
  EXPECT_NEAR(side, .93, .001);
}

TEST(RestRatios, ArePositiveForEdgesWithoutLength) {
  Polygons p = sheared_sheet(4, 0, 0);
  for (int j = 0; j <= 4; ++j) p.points.col(j) = Vec3(-1, 2, 0);  // a pole
  const MemoryOrder memory_order = find_memory_order(static_cast<int>(p.points.cols()), p.triangles);
  for (double ratio : ratios_of(p, memory_order)) EXPECT_GT(ratio, 1e-5);
}

TEST(RestRatios, MustBeOfThePolygonsOfTheMesh) {
  const Polygons pentagon = regular_polygon(5), square = regular_polygon(4), triangle = regular_polygon(3);
  const MemoryOrder two_triangles = find_memory_order(4, square.triangles);
  EXPECT_THROW(ratios_of({square.points, pentagon.corners}, two_triangles), Error);
  EXPECT_THROW(ratios_of({square.points, triangle.corners}, two_triangles), Error);
  const Polygons apart = sheared_sheet(2, 0, 0);
  Polygons crossed = apart;
  std::swap(crossed.triangles[1], crossed.triangles[6]);
  EXPECT_THROW(ratios_of(crossed, find_memory_order(9, crossed.triangles)), Error);
}

TEST(CountWithCorners, CountsPolygons) {
  Polygons p = regular_polygon(5);
  EXPECT_EQ(count_with_corners(p.corners, 4), 0U);
  p.add({0, 1, 2, 3});
  p.add({0, 1, 2});
  EXPECT_EQ(count_with_corners(p.corners, 3), 1U);
  EXPECT_EQ(count_with_corners(p.corners, 4), 1U);
  EXPECT_EQ(count_with_corners({{0}, {}}, 4), 0U);
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

/// A mesh with target lengths, its quadrilaterals with springs of their own.
struct SprungPolygons {
  TriMesh mesh;
  MemoryOrder memory_order;

  explicit SprungPolygons(const Polygons& p, bool has_ratios = true)
      : mesh(build_mesh(p.points, p.triangles)), memory_order(find_memory_order(mesh)) {
    set_target_lengths(mesh, memory_order);
    if (has_ratios)
      set_edge_values(mesh, rest_ratio_property, memory_order.order, *memory_order.adjacency,
                      ratios_of(p, memory_order));
  }
};

TEST(RestRatios, MakeRectanglesOfQuadrilaterals) {
  for (const double width : {1., 4.}) {
    const Polygons p = sheared_sheet(16, width == 1 ? 3 : 0, .2, width);
    SprungPolygons rectangles(p), triangles(p, false);
    EXPECT_EQ(preserving_remesh(rectangles.mesh, rectangles.memory_order, {}).measures->preservation.flaws(),
              0);
    preserving_remesh(triangles.mesh, triangles.memory_order, {});
    const double after = mean_deviation(p, vertex_points(rectangles.mesh));
    EXPECT_LT(after, .75 * mean_deviation(p, p.points));
    EXPECT_LT(after, .75 * mean_deviation(p, vertex_points(triangles.mesh)));
  }
}

TEST(RestRatios, LeaveRectanglesAsTheyAre) {
  Polygons graded = sheared_sheet(12, 0, 0);
  graded.points = (.3 * graded.points.array()).exp();
  SprungPolygons sprung(graded);
  preserving_remesh(sprung.mesh, sprung.memory_order, {});
  EXPECT_LT((vertex_points(sprung.mesh) - graded.points).colwise().norm().maxCoeff(), 1e-6);
}

double rms_deviation(const Polygons& p, const Mat3X& points) {
  return measure_polygon_angles(points, p.corners)->rms_deviation;
}

TEST(KnownPolygons, DoNotGetWorseOnTheWhole) {
  for (const double noise : {.01, .03}) {
    const Polygons p = sheared_sheet(12, 0, noise);
    SprungPolygons triangles(p, false), known(p, false);
    preserving_remesh(triangles.mesh, triangles.memory_order, {});
    EXPECT_GT(mean_deviation(p, vertex_points(triangles.mesh)), mean_deviation(p, p.points) + 1);
    preserving_remesh(known.mesh, known.memory_order, {}, {}, {.polygons = &p.corners});
    EXPECT_LT(rms_deviation(p, vertex_points(known.mesh)), rms_deviation(p, p.points) + 1e-3);
  }
}

TEST(KnownPolygons, MoveWhereTheyGetBetter) {
  const Polygons p = sheared_sheet(12, 0, .25, 2);
  SprungPolygons known(p);
  preserving_remesh(known.mesh, known.memory_order, {}, {}, {.polygons = &p.corners});
  EXPECT_LT(rms_deviation(p, vertex_points(known.mesh)), .8 * rms_deviation(p, p.points));
}

TEST(KnownPolygons, DoNotGetWorseWhenInterrupted) {
  const Polygons p = sheared_sheet(12, 0, .03);
  for (int last_call = 1; last_call < 400; last_call *= 2) {
    SprungPolygons known(p, false);
    int calls = 0;
    preserving_remesh(known.mesh, known.memory_order, {}, {}, {.polygons = &p.corners},
                      [&](const Progress&) { return ++calls < last_call; });
    EXPECT_LT(rms_deviation(p, vertex_points(known.mesh)), rms_deviation(p, p.points) + 1e-3) << last_call;
  }
}

TEST(KnownPolygons, AreForFixedFacesOnly) {
  const Polygons p = sheared_sheet(3, 0, .2);
  SprungPolygons known(p, false);
  RemeshOptions options;
  options.connectivity = ConnectivityMode::flip;
  EXPECT_THROW(preserving_remesh(known.mesh, known.memory_order, options, {}, {.polygons = &p.corners}),
               Error);
}

TEST(RestRatios, AreForFixedFacesOnly) {
  SprungPolygons sprung(sheared_sheet(3, 0, .2));
  RemeshOptions options;
  options.connectivity = ConnectivityMode::flip;
  EXPECT_THROW(preserving_remesh(sprung.mesh, sprung.memory_order, options), Error);
}

TEST(AreaOfSides, IsThatOfTheTriangleAndZeroWithoutOne) {
  EXPECT_DOUBLE_EQ(area_of_sides(3, 4, 5), 6);
  EXPECT_DOUBLE_EQ(area_of_sides(5, 3, 4), 6);
  EXPECT_EQ(area_of_sides(1, 2, 4), 0);
  EXPECT_EQ(area_of_sides(0, 1, 1), 0);
}

}  // namespace
}  // namespace hooke
