// What remeshing keeps of a solid with sharp edges.
#include <gtest/gtest.h>

#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/remesh/options.h"
#include "support/crease_outcome.h"

namespace hooke::crease_remesh_test {

using test::Outcome, test::remeshed, test::natural, test::volume;

RemeshOptions in_mode(ConnectivityMode mode) {
  RemeshOptions options;
  options.connectivity = mode;
  if (mode == ConnectivityMode::flip) options.effort = Effort::fast;
  return options;
}

constexpr ConnectivityMode both_modes[] = {ConnectivityMode::fixed, ConnectivityMode::flip};

TEST(CreaseRemesh, ACubeStaysACube) {
  const test::Triangles t = test::irregular_cube(7);
  for (ConnectivityMode mode : both_modes) {
    const Outcome o = remeshed(t, in_mode(mode));
    expect_flat_faces(t, o, 1e-9);
    expect_same_creases(t, o, 1e-9);
    EXPECT_EQ(o.result.creases.curves, 12);
    EXPECT_EQ(o.result.creases.corners, 8);
    EXPECT_EQ(o.result.creases.charts, 6);
    EXPECT_TRUE(test::turned_faces(t, o.mesh).empty());
    EXPECT_GT(min_angle(o.points, o.faces), min_angle(t.points, t.faces) + 10);
  }
}

TEST(CreaseRemesh, AStepBlockKeepsItsConcaveEdge) {
  const test::Triangles t = test::step_block(4);
  for (ConnectivityMode mode : both_modes) {
    const Outcome o = remeshed(t, in_mode(mode));
    expect_flat_faces(t, o, 1e-9);
    expect_same_creases(t, o, 1e-9);
    EXPECT_EQ(o.result.creases.curves, 18);
    EXPECT_EQ(o.result.creases.corners, 12);
    EXPECT_EQ(o.result.creases.charts, 8);
  }
}

TEST(CreaseRemesh, NoCreaseBecomesAcute) {
  const auto sharpest = [](const Mat3X& points, const std::vector<Triangle>& faces) {
    const Adjacency c = make_adjacency(static_cast<int>(points.cols()), faces);
    double least = 1;
    for (const auto& [left, right] : c.edge_faces)
      if (right >= 0) least = std::min(least, cosine_between(points, faces[left], faces[right]));
    return least;
  };
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const test::Triangles t =
        test::shaken(test::irregular_cube(6, seed), .04, seed);  // rough, with jagged edges
    for (ConnectivityMode mode : both_modes) {
      const Outcome o = remeshed(t, in_mode(mode));
      EXPECT_GT(sharpest(o.points, o.faces), std::min(sharpest(t.points, t.faces), -.1) - .03);
    }
  }
}

TEST(CreaseRemesh, ACylinderStaysRoundUpToItsFeatureEdges) {
  const test::Triangles t = test::cylinder(40, .15);
  const double L = natural(t);
  for (ConnectivityMode mode : both_modes) {
    const Outcome o = remeshed(t, in_mode(mode));
    EXPECT_EQ(o.result.creases.curves, 2);
    EXPECT_EQ(o.result.creases.corners, 0);
    EXPECT_EQ(o.result.creases.charts, 3);
    EXPECT_EQ(o.result.creases.edges, 80);
    int on_features = 0;
    for (Eigen::Index v = 0; v < o.points.cols(); ++v) {
      const Vec3 x = o.points.col(v);
      const double r = std::hypot(x[0], x[1]);
      const bool on_cap = std::min(std::abs(x[2]), std::abs(x[2] - 2)) < 1e-9 * L;
      if (!on_cap) {
        EXPECT_NEAR(r, 1, 2e-3 * L);
      }
      EXPECT_LE(r, 1 + 2e-3 * L);
      on_features += on_cap && r > .98;  // the circular edges are polygons of 40 edges
    }
    EXPECT_EQ(on_features, 80);
    EXPECT_TRUE(test::turned_faces(t, o.mesh).empty());
    EXPECT_GT(min_angle(o.points, o.faces), min_angle(t.points, t.faces) + 3);
  }
}

TEST(CreaseRemesh, AnEvenFeatureCurveStaysAsItIs) {
  const test::Triangles t = test::cylinder(40, .1);
  const auto features = test::bent_edges(t.points, t.faces);
  for (ConnectivityMode mode : both_modes) {
    const Outcome o = remeshed(t, in_mode(mode));
    EXPECT_EQ(test::bent_edges(o.points, o.faces), features);
    for (const Edge& edge : features)
      for (int v : edge) EXPECT_EQ(o.points.col(v), t.points.col(v));
  }
}

TEST(CreaseRemesh, WithoutCreasesACubeIsRounded) {
  const test::Triangles t = test::irregular_cube(7);
  RemeshOptions options;
  options.constraints.features.angle = 180;
  const Outcome o = remeshed(t, options);
  EXPECT_EQ(o.result.creases.edges, 0);
  EXPECT_GT(std::abs(volume(o.points, o.faces) / volume(t.points, t.faces) - 1), 1e-5);
}

TEST(CreaseRemesh, EveryFilterKeepsTheSidesFlat) {
  const test::Triangles t = test::irregular_cube(4);
  for (FilterKind kind : {FilterKind::local, FilterKind::global, FilterKind::closest}) {
    RemeshOptions options;
    options.filter.kind = kind;
    const Outcome o = remeshed(t, options);
    expect_flat_faces(t, o, 1e-6);
    expect_same_creases(t, o, 1e-6);
  }
}

TEST(CreaseRemesh, ThoroughFlipsKeepCreases) {
  const test::Triangles t = test::irregular_cube(5);
  RemeshOptions thorough = in_mode(ConnectivityMode::flip);
  thorough.effort = Effort::thorough;
  RunOptions options(thorough);
  options.flips.flow_rounds = 20;
  options.flips.passes.passes = 2;
  const Outcome o = remeshed(t, options);
  expect_flat_faces(t, o, 1e-9);
  expect_same_creases(t, o, 1e-9);
}

TEST(CreaseRemesh, ACubeOfTwelveFacesIsLeftAlone) {
  const test::Triangles t = test::cube();
  for (ConnectivityMode mode : both_modes) EXPECT_EQ(remeshed(t, in_mode(mode)).points, t.points);
}

TEST(CreaseRemesh, AScaleOfTwoChangesNothing) {
  const test::Triangles t = test::step_block(3);
  test::Triangles large = t;
  large.points *= 4;
  for (ConnectivityMode mode : both_modes)
    EXPECT_EQ(remeshed(large, in_mode(mode)).points, 4 * remeshed(t, in_mode(mode)).points);
}

TEST(CreaseRemesh, ThreadsChangeNothing) {
  const test::Triangles t = test::irregular_cube(8);
  for (ConnectivityMode mode : both_modes) {
    Mat3X one, two;
    {
      const ThreadLimit limit(1);
      one = remeshed(t, in_mode(mode)).points;
    }
    {
      const ThreadLimit limit(2);
      two = remeshed(t, in_mode(mode)).points;
    }
    EXPECT_EQ(one, two);
  }
}

}  // namespace hooke::crease_remesh_test
