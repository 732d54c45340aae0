#include "hooke/constraints/zigzag_strips.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "hooke/constraints/crease_detection.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/normals.h"
#include "support/crease_outcome.h"
#include "support/solids.h"

namespace hooke::zigzag_strips_test {

struct Smoothed {
  Adjacency adjacency;
  Mat3X normals;
  std::vector<char> is_fold;

  long folds() const { return std::ranges::count(is_fold, 1); }
};

Smoothed smooth(const test::Triangles& t, double length = 1) {
  Smoothed s{test::connect(t), {}, {}};
  s.normals = face_normals(t.points, s.adjacency);
  s.is_fold = smooth_zigzag_strips(t.points, s.adjacency,
                                   std::vector<double>(s.adjacency.vertex_count, length), s.normals);
  return s;
}

std::size_t creases(const test::Triangles& t, const CreaseOptions& options = {}, double length = 1) {
  const Adjacency c = test::connect(t);
  return detect_creases(t.points, c, std::vector<double>(c.vertex_count, length), options).size();
}

TEST(ZigzagStrips, ATwistedPrismHasCreasesAtItsCornersAndRims) {
  for (const int sides : {3, 4, 6})
    for (const double degrees : {-180, 20, 90, 180}) {
      const test::Triangles t = test::twisted_prism(sides, 30, degrees, 25);
      EXPECT_EQ(creases(t), sides * (30 + 2)) << sides << " sides, twisted by " << degrees;
      EXPECT_EQ(smooth(t).folds(), sides * (2 * 30 - 1)) << sides << " sides, twisted by " << degrees;
    }
}

TEST(ZigzagStrips, TheirNormalsTurnAsTheSmoothSurfaceDoes) {
  const test::Triangles t = test::twisted_prism(4, 60, 90, 25);
  const Smoothed s = smooth(t);
  const Mat3X before = face_normals(t.points, s.adjacency);
  const auto turn = [&](const Mat3X& normals, std::size_t e) {
    const auto& [left, right] = s.adjacency.edge_faces[e];
    return std::acos(std::clamp(normals.col(left).dot(normals.col(right)), -1., 1.)) * 180 / std::numbers::pi;
  };
  for (std::size_t e = 0; e < s.is_fold.size(); ++e)
    if (s.is_fold[e]) {
      EXPECT_GT(turn(before, e), 40);
      const auto [low, high] =
          std::minmax(t.points(2, s.adjacency.edges[e][0]), t.points(2, s.adjacency.edges[e][1]));
      if (low > .5 && high < 24.5) {
        EXPECT_LT(turn(s.normals, e), 1);
      }
    }
}

TEST(ZigzagStrips, NeedlesMayBeOfSeveralFaces) {
  test::Triangles t = test::twisted_prism(4, 20, 90, 16);
  const Smoothed whole = smooth(t);
  // Each fold gets a vertex in its middle.
  const Adjacency c = test::connect(t);
  std::vector<int> middle(c.edges.size(), -1);
  auto count = static_cast<int>(t.points.cols());
  t.points.conservativeResize(3, count + whole.folds());
  for (std::size_t e = 0; e < middle.size(); ++e)
    if (whole.is_fold[e]) {
      t.points.col(count) = .5 * (t.points.col(c.edges[e][0]) + t.points.col(c.edges[e][1]));
      middle[e] = count++;
    }
  for (std::size_t f = 0; f < c.faces.size(); ++f) {
    std::vector<int> polygon;
    for (std::size_t k = 0; k < 3; ++k) {
      polygon.push_back(c.faces[f][k]);
      if (const int m = middle[c.face_edges[f][k]]; m >= 0) polygon.push_back(m);
    }
    if (polygon.size() == 3) continue;
    // A fan from a middle, so that no face is without area.
    const auto first = std::ranges::find_if(polygon, [&](int v) { return v >= c.vertex_count; });
    std::rotate(polygon.begin(), first, polygon.end());
    t.faces[f] = {polygon[0], polygon[1], polygon[2]};
    for (std::size_t i = 2; i + 1 < polygon.size(); ++i)
      t.faces.push_back({polygon[0], polygon[i], polygon[i + 1]});
  }
  EXPECT_EQ(smooth(t).folds(), 2 * whole.folds());
  EXPECT_EQ(creases(t), 4 * (20 + 2));
}

TEST(ZigzagStrips, FoldsThatTheTargetLengthResolvesStay) {
  const test::Triangles t = test::twisted_prism(4, 10, 90, 30);
  EXPECT_EQ(smooth(t, 4).folds(), 4 * (2 * 10 - 1));
  EXPECT_EQ(smooth(t, 1).folds(), 0);
  EXPECT_EQ(creases(t, {}, 1), 4 * (10 + 2) + 4 * (2 * 10 - 1));
}

TEST(ZigzagStrips, WithoutNoiseAllSharpEdgesAreCreases) {
  const test::Triangles t = test::twisted_prism(4, 20, 180, 30);
  EXPECT_EQ(creases(t, {.drops_noise = false}), 4 * (20 + 2) + 4 * (2 * 20 - 1));
}

struct Pleats {
  int count = 12;                          // of flat facets, each of two triangles
  double wide = 1, narrow = .2;            // their ends, which are at either border by turns
  double length = 20;                      // from border to border
  std::array<double, 2> folds = {60, 60};  // degrees, out and in by turns
};

/// A sheet in pleats, with a boundary.
test::Triangles pleated(const Pleats& o) {
  test::Triangles t{Mat3X(3, 2 * o.count + 2), {}};
  Vec3 low(0, 0, 0), high(0, o.length, 0);
  double direction = 0;  // degrees, in planes across the folds
  for (int i = 0; i <= o.count; ++i) {
    t.points.col(2 * i) = low;
    t.points.col(2 * i + 1) = high;
    const double angle = direction * std::numbers::pi / 180;
    const Vec3 along(std::cos(angle), 0, std::sin(angle));
    low += (i % 2 == 0 ? o.wide : o.narrow) * along;
    high += (i % 2 == 0 ? o.narrow : o.wide) * along;
    direction += i % 2 == 0 ? o.folds[0] : -o.folds[1];
    if (i == o.count) break;
    t.faces.push_back({2 * i, 2 * i + 2, 2 * i + 3});
    t.faces.push_back({2 * i, 2 * i + 3, 2 * i + 1});
  }
  return t;
}

TEST(ZigzagStrips, SixFoldsOrMoreInARow) {
  EXPECT_EQ(smooth(pleated({})).folds(), 11);
  EXPECT_EQ(smooth(pleated({.count = 7})).folds(), 6);
  EXPECT_EQ(smooth(pleated({.count = 6})).folds(), 0);
}

TEST(ZigzagStrips, PleatsWithoutPointsAreNone) {
  EXPECT_EQ(smooth(pleated({.narrow = 1})).folds(), 0);
  EXPECT_EQ(smooth(pleated({.narrow = .6})).folds(), 0);
}

TEST(ZigzagStrips, WideFacetsAreNone) {
  // Few, as such a sheet leans over more with each, so that its facets become needles.
  EXPECT_EQ(smooth(pleated({.count = 8, .length = 1})).folds(), 0);
}

TEST(ZigzagStrips, FoldsAreAboutAlikeAndNotSteep) {
  EXPECT_EQ(smooth(pleated({.folds = {30, 50}})).folds(), 11);
  EXPECT_EQ(smooth(pleated({.folds = {20, 60}})).folds(), 0);
  EXPECT_EQ(smooth(pleated({.folds = {130, 130}})).folds(), 0);
}

TEST(ZigzagStrips, FoldsThatAllBendOutAreNone) {
  test::Triangles drum{Mat3X(3, 40), {}};  // an antiprism without its ends
  for (int i = 0; i < 40; ++i) {
    const double turn = i * std::numbers::pi / 20;
    drum.points.col(i) << 4 * std::cos(turn), 4 * std::sin(turn), i % 2 ? 20 : 0;
    if (i % 2)
      drum.faces.push_back({i, (i + 1) % 40, (i + 2) % 40});
    else
      drum.faces.push_back({(i + 1) % 40, i, (i + 2) % 40});
  }
  EXPECT_EQ(smooth(drum, 4).folds(), 0);
}

TEST(ZigzagStrips, FacesOfAFacetAreAboutInOnePlane) {
  test::Triangles t = pleated({});
  for (Eigen::Index v = 0; v < t.points.cols(); ++v) t.points(2, v) += v % 4 < 2 ? .0005 : -.0005 * (v % 3);
  EXPECT_EQ(smooth(t).folds(), 11);
}

TEST(ZigzagStrips, FacesWithoutAreaDoNotBreakThem) {
  test::Triangles t = test::twisted_prism(4, 20, 90, 16);
  const auto middle = static_cast<int>(t.points.cols());
  t.points.conservativeResize(3, middle + 1);
  const Triangle face = t.faces[80];  // its first edge is a fold
  t.points.col(middle) = .5 * (t.points.col(face[0]) + t.points.col(face[1]));
  t.faces[80] = {middle, face[1], face[2]};
  t.faces.push_back({face[0], middle, face[2]});
  t.faces.push_back({face[0], face[1], middle});
  const Adjacency c = test::connect(t);
  Mat3X normals = certain_face_normals(t.points, c);
  ASSERT_EQ(Vec3(normals.rightCols(1)), Vec3(0, 0, 0));
  const auto is_fold = smooth_zigzag_strips(t.points, c, std::vector<double>(c.vertex_count, 1), normals);
  EXPECT_EQ(Vec3(normals.rightCols(1)), Vec3(0, 0, 0));
  EXPECT_GE(std::ranges::count(is_fold, 1), 4 * (2 * 20 - 1));
}

TEST(ZigzagStrips, HardEdgesAreKeptThere) {
  const test::Triangles t = test::twisted_prism(4, 20, 90, 16);
  const Smoothed s = smooth(t);
  std::vector<Edge> hard;
  for (std::size_t e = 0; e < s.is_fold.size(); ++e)
    if (s.is_fold[e]) hard.push_back(s.adjacency.edges[e]);
  const std::vector<double> length(s.adjacency.vertex_count, 1);
  EXPECT_EQ(detect_creases(t.points, s.adjacency, length, {}, hard).size(), 4 * (20 + 2) + hard.size());
}

TEST(ZigzagStrips, FoldsThatMeetAtAPointAreAStar) {
  test::Triangles star{Mat3X(3, 42), {}};
  star.points.col(40) << 0, 0, 20;
  star.points.col(41) << 0, 0, 0;
  for (int i = 0; i < 40; ++i) {
    const double turn = i * std::numbers::pi / 20, radius = i % 2 ? 6 : 8;
    star.points.col(i) << radius * std::cos(turn), radius * std::sin(turn), 0;
    star.faces.push_back({i, (i + 1) % 40, 40});
    star.faces.push_back({(i + 1) % 40, i, 41});
  }
  EXPECT_EQ(smooth(star, 4).folds(), 0);
}

TEST(ZigzagStrips, ATwistedPrismIsRemeshedAsWhatItIs) {
  for (const int sides : {3, 4, 6}) {
    const test::Triangles t = test::twisted_prism(sides, 30, 150, 40);
    RemeshOptions options;
    options.connectivity = ConnectivityMode::adapt;
    const test::Outcome o = test::remeshed(t, options);
    EXPECT_GT(min_angle(o.points, o.faces), 30) << sides;
    const double smooth_volume = 40 * .5 * sides * 10 * 10 * std::sin(2 * std::numbers::pi / sides);
    EXPECT_NEAR(test::volume(o.points, o.faces) / smooth_volume, 1, .02) << sides;
    EXPECT_EQ(o.result.creases.curves, 3 * sides);
    EXPECT_EQ(o.result.creases.corners, 2 * sides);
  }
}

}  // namespace hooke::zigzag_strips_test
