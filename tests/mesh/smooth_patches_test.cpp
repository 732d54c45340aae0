#include "hooke/mesh/smooth_patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hooke/constraints/crease_detection.h"
#include "hooke/mesh/extent.h"
#include "hooke/mesh/sagitta.h"
#include "hooke/springs/target_lengths.h"
#include "support/masks.h"
#include "support/solids.h"

namespace hooke::smooth_patches_test {

/// By marching tetrahedra. The function is a sum of those of each coordinate, so that a cell of the grid,
/// where it is linear, has a flat piece of the surface.
test::Triangles isosurface(int size, const Vec3& radii) {
  return test::marched_level(
      size, [&](const Vec3& x) { return (x - Vec3(.13, .21, .08)).cwiseQuotient(radii).squaredNorm() - 1; });
}

test::Triangles rotated(test::Triangles t) {
  t.points = (Eigen::AngleAxisd(.7, Vec3(1, 2, -1).normalized()).toRotationMatrix() * t.points).eval();
  return t;
}

double natural_length_of(const test::Triangles& t) {
  return natural_length(total_area(t.points, t.faces), t.faces.size());
}

std::ptrdiff_t marked_faces(const test::Triangles& t) {
  const Adjacency c = test::connect(t);
  std::vector<char> flat, sharp;
  for (const EdgeArc& arc : edge_arcs(t.points, c)) {
    flat.push_back(arc.chord > 0 && arc.sagitta < 1e-6 * arc.chord);
    sharp.push_back(arc.sagitta > .1 * arc.chord);
  }
  return std::ranges::count(faces_in_smooth_patches(t.points, c, flat, sharp), 1);
}

TEST(SmoothPatches, TheCellsOfAnIsosurfaceAreSuch) {
  for (const test::Triangles& t : {isosurface(9, {7.3, 7.3, 7.3}), isosurface(9, {8.1, 6.2, 4.4})}) {
    EXPECT_GT(marked_faces(t), .5 * static_cast<double>(t.faces.size()));
    EXPECT_EQ(marked_faces(rotated(t)), marked_faces(t));
  }
}

TEST(SmoothPatches, QuadrilateralsAndFewPatchesMayBeFacets) {
  for (const test::Triangles& t : {test::globe(24, 12), test::cube(), isosurface(3, {2, 2, 2})})
    EXPECT_EQ(marked_faces(t), 0);
}

/// A sheet of pieces that slope to and fro, of eight faces each: they are alike, as facets are.
test::Triangles sheet_of_facets(int cells) {
  test::Triangles t = test::grid(cells, test::flat);
  t.points *= cells;
  const auto slope = [](double x) { return .25 * std::abs(std::remainder(x, 4.)); };
  for (auto x : t.points.colwise()) x[2] = slope(x[0]) + slope(x[1]);
  return t;
}

TEST(SmoothPatches, FacetsThatAreAlikeAreNone) {
  const test::Triangles t = sheet_of_facets(40);
  EXPECT_EQ(marked_faces(t), 0);
  const Adjacency c = test::connect(t);
  const std::vector<double> lengths(c.vertex_count, 1);
  EXPECT_EQ(detect_creases(t.points, c, lengths, {}, {}).size(), 2u * 19 * 40);
}

TEST(SmoothPatches, AnIsosurfaceBesideAPartTakesNoneOfItsFacets) {
  const test::Triangles ball = isosurface(9, {7.3, 7.3, 7.3});
  test::Triangles facets = sheet_of_facets(40);
  facets.points.colwise() += Vec3(20, 0, 0);
  EXPECT_EQ(marked_faces(test::both(ball, facets)), marked_faces(ball));
}

TEST(SmoothPatches, AnIsosurfaceHasNoCreasesAndNoFacets) {
  for (const test::Triangles& t :
       {isosurface(9, {7.3, 7.3, 7.3}), isosurface(9, {8.1, 6.2, 4.4}), rotated(isosurface(9, {8, 7, 5}))}) {
    const Adjacency c = test::connect(t);
    for (double times : {.3, 1., 3.}) {
      const std::vector<double> lengths(c.vertex_count, times * natural_length_of(t));
      EXPECT_TRUE(detect_creases(t.points, c, lengths, {}, {}).empty()) << times;
    }
    EXPECT_FALSE(is_faceted(t.points, c));
  }
}

/// Where it ends at a flat side the edges between them are creases, and hardly any others.
TEST(SmoothPatches, AFlatSideOfItEndsAtCreases) {
  const double radius = 8.2, bottom = 2.5;
  const test::Triangles dome = test::marched_level(9, [&](const Vec3& x) {
    return std::max((x.squaredNorm() - radius * radius) / (2 * radius), bottom - x[2]);
  });
  const Adjacency c = test::connect(dome);
  const std::vector<double> lengths(c.vertex_count, natural_length_of(dome));
  const std::vector<int> creases = detect_creases(dome.points, c, lengths, {}, {});
  EXPECT_GT(creases.size(), 2 * radius * std::numbers::pi);  // cells around it
  const auto is_high = [&](int e) { return dome.points(2, c.edges[e][0]) > bottom + 1; };
  EXPECT_LT(static_cast<double>(std::ranges::count_if(creases, is_high)),
            .05 * static_cast<double>(creases.size()));
}

/// A terrain with cells of 30, whose heights are in steps, with its points as floats or not.
test::Triangles terrain(double step, bool is_float = false) {
  test::Triangles t =
      test::grid(40, [](double x, double y) { return .03 * std::sin(5 * x + 1) * std::cos(4 * y); });
  t.points *= 1200;
  for (double& height : t.points.row(2)) height = step * std::round(height / step);
  if (is_float) t.points = t.points.cast<float>().cast<double>();
  return t;
}

bool has_facets(const test::Triangles& t) {
  const Adjacency c = test::connect(t);
  const std::vector<double> lengths(c.vertex_count, natural_length_of(t));
  return !detect_creases(t.points, c, lengths, {}, {}).empty() || is_faceted(t.points, c);
}

TEST(SmoothPatches, HeightsInStepsMakeNoFacets) {
  for (const double step : {1., .1 * 3.048, 2. / 3}) {
    EXPECT_FALSE(has_facets(terrain(step))) << step;
    EXPECT_FALSE(has_facets(terrain(step, true))) << step;
  }
  EXPECT_GT(marked_faces(terrain(1)), .5 * static_cast<double>(terrain(1).faces.size()));
  test::Triangles moved = terrain(1);
  moved.points.row(2).array() += 512.5;
  EXPECT_EQ(marked_faces(moved), marked_faces(terrain(1)));
}

/// Cells as long as the steps are those of a grid: the facets are meant.
TEST(SmoothPatches, StepsAsLongAsEdgesAreNoRounding) {
  test::Triangles t = sheet_of_facets(40);
  EXPECT_TRUE(has_facets(t));
  t.points.row(2) *= .5;
  EXPECT_TRUE(has_facets(t));
}

/// Of low panels and pyramids, with few heights.
TEST(SmoothPatches, ShallowReliefIsNoRounding) {
  const auto relief = [](double (*height)(double x, double y)) {
    test::Triangles t = test::grid(48, test::flat);
    t.points.topRows(2) *= 48;
    for (auto x : t.points.colwise()) x[2] = .1 * height(std::round(x[0]), std::round(x[1]));
    return t;
  };
  const auto panels = [](double x, double y) { return std::fmod(x, 4) < 2 && std::fmod(y, 4) < 2 ? 1. : 0; };
  const auto pyramids = [](double x, double y) {
    return std::min(std::abs(std::remainder(x, 4)), std::abs(std::remainder(y, 4)));
  };
  for (const test::Triangles& t : {relief(panels), relief(pyramids)}) EXPECT_EQ(marked_faces(t), 0);
}

TEST(SmoothPatches, FoldsThatTurnMoreThanRoundingAreMeant) {
  test::Triangles pleats = test::grid(40, test::flat);
  pleats.points.topRows(2) *= 40;
  for (auto x : pleats.points.colwise())
    x[2] = .01 * std::round(8.3 * std::abs(std::remainder(x[0] + .013 * x[1], 12.)) + .77 * x[1]);
  EXPECT_EQ(marked_faces(pleats), 0);
}

}  // namespace hooke::smooth_patches_test
