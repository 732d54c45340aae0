// What mode adapt keeps of a solid with sharp edges.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"
#include "hooke/measure/quality.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/topology.h"
#include "hooke/remesh/options.h"
#include "support/crease_outcome.h"

namespace hooke::crease_adapt_test {

using test::natural, test::Outcome, test::remeshed;

RemeshOptions adaptation_options() {
  RemeshOptions options;
  options.connectivity = ConnectivityMode::adapt;
  options.effort = Effort::fast;
  options.map = true;
  return options;
}

/// As many faces as the target length asks for, and a sound surface.
/// With `round`, edges may be folded: right angles along circular edges can be slightly less than 90 degrees.
void expect_sound(const Outcome& o, double faces, bool round = false) {
  EXPECT_NEAR(static_cast<double>(o.faces.size()), faces, std::max(2.5, .03 * faces));
  const Adjacency c = make_adjacency(static_cast<int>(o.points.cols()), o.faces);
  EXPECT_EQ(measure_topology(c).euler, 2);
  const Quality quality = measure_quality(o.points, c, std::vector<double>(c.edges.size(), 1.));
  if (!round) {
    EXPECT_EQ(quality.folded_edges, 0u);
  }
  EXPECT_EQ(quality.self_intersections.value_or(1), 0u);
}

TEST(CreaseAdapt, ACubeStaysACube) {
  const test::Triangles t = test::irregular_cube(7);
  for (double factor : {.35, 1., 3.}) {
    const Outcome o = remeshed(t, factor * natural(t), adaptation_options());
    expect_sound(o, static_cast<double>(t.faces.size()) / (factor * factor));
    expect_flat_faces(t, o, 1e-9);
    expect_same_creases(t, o, 1e-9);
    EXPECT_EQ(o.result.creases.curves, 12);
    EXPECT_EQ(o.result.creases.corners, 8);
    EXPECT_EQ(o.result.creases.charts, 6);
    EXPECT_GT(min_angle(o.points, o.faces), 30);
  }
}

TEST(CreaseAdapt, AStepBlockKeepsItsConcaveEdge) {
  const test::Triangles t = test::step_block(4);
  for (double factor : {.5, 1., 2.}) {
    const Outcome o = remeshed(t, factor * natural(t), adaptation_options());
    expect_sound(o, static_cast<double>(t.faces.size()) / (factor * factor));
    expect_flat_faces(t, o, 1e-9);
    expect_same_creases(t, o, 1e-9);
    EXPECT_EQ(o.result.creases.curves, 18);
    EXPECT_EQ(o.result.creases.corners, 12);
    EXPECT_EQ(o.result.creases.charts, 8);
    EXPECT_GT(min_angle(o.points, o.faces), 28);
  }
}

TEST(CreaseAdapt, ACubeOfTwelveFacesIsRefined) {
  const test::Triangles t = test::cube();
  const Outcome o = remeshed(t, .2 * natural(t), adaptation_options());
  expect_sound(o, 12 * 25);
  expect_flat_faces(t, o, 1e-9);
  expect_same_creases(t, o, 1e-9);
  EXPECT_GT(min_angle(o.points, o.faces), 30);
}

TEST(CreaseAdapt, AStripHalfAsWideAsTheLengthHasNoInnerVertices) {
  for (const double width : {.2, .35, .5})
    for (const double height : {1.4, 2., 2.6, 3., 4., 5.5}) {
      test::Triangles strip{Mat3X(3, 4), {{0, 1, 2}, {0, 2, 3}}};
      strip.points << 0, width, width, 0, 0, 0, height, height, 0, 0, 0, 0;
      const Outcome o = remeshed(strip, 1, adaptation_options());
      const Mat3X& p = o.points;
      const auto is_inner = [&](int v) {
        return p(0, v) > 0 && p(0, v) < width && p(1, v) > 0 && p(1, v) < height;
      };
      for (int v = 0; v < p.cols(); ++v) EXPECT_FALSE(is_inner(v)) << width << " x " << height;
      // As many rectangles as the longer edges are cut in, each with a diagonal, or better.
      const double rectangle = height / std::floor(.5 * static_cast<double>(o.faces.size()));
      const double diagonals = std::atan(std::min(width, rectangle) / std::max(width, rectangle));
      EXPECT_GT(min_angle(p, o.faces), .8 * diagonals * 180 / std::numbers::pi) << width << " x " << height;
    }
}

TEST(CreaseAdapt, ACylinderStaysRoundUpToItsFeatureEdges) {
  const test::Triangles t = test::cylinder(40, .15);
  const double L = natural(t);
  for (double factor : {.5, 1., 2.}) {
    const Outcome o = remeshed(t, factor * natural(t), adaptation_options());
    expect_sound(o, static_cast<double>(t.faces.size()) / (factor * factor), true);
    EXPECT_EQ(o.result.creases.curves, 2);
    EXPECT_EQ(o.result.creases.charts, 3);
    EXPECT_EQ(o.result.creases.edges, o.result.creases.curve_vertices);
    for (Eigen::Index v = 0; v < o.points.cols(); ++v) {
      const Vec3 x = o.points.col(v);
      const bool on_cap = std::min(std::abs(x[2]), std::abs(x[2] - 2)) < 1e-9 * L;
      if (!on_cap) {
        EXPECT_NEAR(std::hypot(x[0], x[1]), 1, 3e-3 * L);
      }
      EXPECT_LE(std::hypot(x[0], x[1]), 1 + 3e-3 * L);
    }
  }
}

TEST(CreaseAdapt, AnEvenFeatureCurveStaysAsItIsUnlessItIsToHaveOtherEdges) {
  const test::Triangles t = test::cylinder(40, .1);
  for (double factor : {.5, 1., 2.}) {
    const Outcome o = remeshed(t, factor * natural(t), adaptation_options());
    EXPECT_NEAR(o.result.creases.edges, 80 / factor, .1 * 80 / factor);
    double farthest = 0;  // from the circular edges of the input to those of the result
    const auto features = test::bent_edges(o.points, o.faces);
    for (Eigen::Index v = 0; v < t.points.cols(); ++v) {
      const Vec3 x = t.points.col(v);
      if ((x[2] != 0 && x[2] != 2) || std::hypot(x[0], x[1]) < 1 - 1e-9) continue;
      double nearest = std::numeric_limits<double>::infinity();
      for (const auto& [a, b] : features)
        nearest = std::min(nearest, distance_to_segment(x, o.points.col(a), o.points.col(b)));
      farthest = std::max(farthest, nearest);
    }
    EXPECT_LT(farthest, factor == 1 ? 1e-12 : .1 * natural(t) * factor);
  }
}

TEST(CreaseAdapt, TheMapReproducesThePointsOnCreases) {
  const test::Triangles t = test::cylinder(30);
  const double L = natural(t);
  const Outcome o = remeshed(t, .7 * natural(t), adaptation_options());
  ASSERT_EQ(o.result.map.size(), o.points.cols());
  int on_caps = 0;
  for (size_t v = 0; v < o.result.map.size(); ++v) {
    const Vec3 x = o.points.col(static_cast<Eigen::Index>(v));
    if (std::min(std::abs(x[2]), std::abs(x[2] - 2)) > 1e-9 * L) continue;
    const SurfacePoint& place = o.result.map[v].position;
    Vec3 y = Vec3::Zero();
    for (size_t k = 0; k < 3; ++k)
      y += place.weights[static_cast<Eigen::Index>(k)] * t.points.col(t.faces[place.face][k]);
    EXPECT_LT((x - y).norm(), 1e-9 * L);
    ++on_caps;
  }
  EXPECT_GT(on_caps, 60);
}

TEST(CreaseAdapt, AScaleOfTwoChangesNothing) {
  const test::Triangles t = test::step_block(3);
  test::Triangles large = t;
  large.points *= 4;
  const Outcome one = remeshed(t, .8 * natural(t), adaptation_options()),
                four = remeshed(large, .8 * natural(large), adaptation_options());
  EXPECT_EQ(4 * one.points, four.points);
  EXPECT_EQ(one.faces, four.faces);
}

TEST(CreaseAdapt, ThreadsChangeNothing) {
  const test::Triangles t = test::irregular_cube(8);
  std::vector<Outcome> outcomes;
  for (int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    outcomes.push_back(remeshed(t, .8 * natural(t), adaptation_options()));
  }
  EXPECT_EQ(outcomes[0].points, outcomes[1].points);
  EXPECT_EQ(outcomes[0].faces, outcomes[1].faces);
}

}  // namespace hooke::crease_adapt_test
