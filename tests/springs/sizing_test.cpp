#include "hooke/springs/sizing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hooke/core/error.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/adjacency.h"
#include "support/solids.h"

namespace hooke::sizing_test {

std::vector<double> wild_lengths(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> exponent(-2, 1);
  std::vector<double> lengths(count);
  for (double& l : lengths) l = std::pow(10, exponent(random));
  return lengths;
}

struct Limited {
  test::Triangles t = test::sphere(3, .3, 7);
  Adjacency c = test::connect(t);
  std::vector<double> given = wild_lengths(c.vertex_count, 3), lengths = given;
  double slope = .3;

  Limited() { limit_gradation(t.points, c, slope, lengths); }

  /// The maximum length that the neighbour `from` allows at `to`.
  double most(int from, int to) const {
    return lengths[from] + slope * (t.points.col(to) - t.points.col(from)).norm();
  }
};

TEST(Gradation, HoldsAlongEveryEdge) {
  const Limited l;
  for (const auto& [a, b] : l.c.edges) {
    EXPECT_LE(l.lengths[b], l.most(a, b));
    EXPECT_LE(l.lengths[a], l.most(b, a));
  }
}

TEST(Gradation, LowersAsLittleAsItMust) {
  const Limited l;
  int lowered = 0;
  for (int v = 0; v < l.c.vertex_count; ++v) {
    const double given = l.given[v], length = l.lengths[v];
    EXPECT_LE(length, given);
    if (length == given) continue;
    ++lowered;
    const auto neighbours = l.c.vertex_neighbours[v];
    EXPECT_TRUE(std::ranges::any_of(neighbours, [&](int w) { return l.most(w, v) == length; })) << v;
  }
  EXPECT_GT(lowered, l.c.vertex_count / 2);
}

TEST(Gradation, WhatObeysStays) {
  const Limited l;
  std::vector<double> again = l.lengths;
  limit_gradation(l.t.points, l.c, l.slope, again);
  EXPECT_EQ(again, l.lengths);
  std::vector<double> free = l.given;
  limit_gradation(l.t.points, l.c, std::numeric_limits<double>::infinity(), free);
  EXPECT_EQ(free, l.given);
}

TEST(Gradation, APowerOfTwoScalesTheResultExactly) {
  const Limited l;
  std::vector<double> scaled = l.given;
  for (double& x : scaled) x *= 8;
  limit_gradation(8 * l.t.points, l.c, l.slope, scaled);
  for (size_t v = 0; v < scaled.size(); ++v) EXPECT_EQ(scaled[v], 8 * l.lengths[v]);
}

using Kind = SizingSource::Kind;

TEST(SizingSource, MeansWhatItSays) {
  EXPECT_EQ(parse_sizing("curvature").kind, Kind::curvature);
  EXPECT_EQ(parse_sizing("./curvature").kind, Kind::file);
  const SizingSource absolute = parse_sizing("curvature:.5"), percent = parse_sizing("curvature:2%");
  EXPECT_EQ(absolute.chord_error, .5);
  EXPECT_FALSE(absolute.percent);
  EXPECT_EQ(percent.chord_error, 2);
  EXPECT_TRUE(percent.percent);
  EXPECT_EQ(parse_sizing("input").kind, Kind::input);
  EXPECT_EQ(parse_sizing("./input").kind, Kind::file);
  EXPECT_EQ(parse_sizing("ply:size").kind, Kind::ply_property);
  EXPECT_EQ(parse_sizing("ply:size").name, "size");
  EXPECT_EQ(parse_sizing("a:b.txt").name, "a:b.txt");
}

TEST(SizingSource, RefusesWhatIsNone) {
  for (const char* text : {"", "ply:", "curvature:", "curvature:0", "curvature:-1", "curvature:nan",
                           "curvature:1x", "curvature:inf", "curvature:1 %"})
    EXPECT_THROW(parse_sizing(text), Error) << text;
}

TEST(InputLengths, AreThoseOfEquilateralFacesAndScaleWithTheMesh) {
  const test::Triangles t = test::sphere(2, .3, 1);
  const Adjacency c = test::connect(t);
  const std::vector<double> lengths = input_lengths(t.points, c);
  ASSERT_EQ(std::ssize(lengths), t.points.cols());
  for (int v = 0; v < c.vertex_count; ++v) {
    double area = 0, count = 0;
    for (const Triangle& f : c.faces)
      if (std::ranges::count(f, v) > 0) {
        area += face_shape(t.points, f).area;
        ++count;
      }
    EXPECT_NEAR(std::sqrt(3) / 4 * lengths[v] * lengths[v], area / count, 1e-12);
  }
  const std::vector<double> scaled = input_lengths(8 * t.points, c);
  for (std::size_t v = 0; v < lengths.size(); ++v) EXPECT_EQ(scaled[v], 8 * lengths[v]);
}

TEST(InputLengths, ArePositiveWhereFacesHaveNoArea) {
  test::Triangles t = test::sphere(1, 0, 1);
  const Triangle f = t.faces.front();
  const Adjacency c = test::connect(t);
  for (const Triangle& g : c.faces)
    if (std::ranges::count(g, f[0]) > 0)
      for (int v : g) t.points.col(v) = t.points.col(f[0]);
  for (double l : input_lengths(t.points, c)) EXPECT_GT(l, 0);
}

}  // namespace hooke::sizing_test
