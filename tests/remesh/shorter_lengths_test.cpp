#include "hooke/remesh/shorter_lengths.h"

#include <gtest/gtest.h>

#include <cmath>

#include "hooke/mesh/extent.h"
#include "hooke/mesh/mesh.h"
#include "hooke/remesh/preserving_remesh.h"
#include "support/crease_outcome.h"
#include "support/remeshed.h"
#include "support/solids.h"

namespace hooke::shorter_lengths_test {

struct Adapted {
  test::Outcome outcome;
  double asked;  // faces

  const ResultMeasures& measures() const { return *outcome.result.measures; }
  double volume_change() const { return *measures().deviation.volume_change; }
};

RemeshOptions options() {
  RemeshOptions options;
  options.connectivity = ConnectivityMode::adapt;
  options.effort = Effort::fast;
  return options;
}

Adapted adapted(const test::Triangles& t, double length, const PreservationOptions& preservation = {}) {
  Adapted a;
  a.outcome.mesh = test::with_length(t, length);
  a.asked = total_area(t.points, t.faces) / (std::sqrt(3) / 4 * length * length);
  a.outcome.result =
      preserving_remesh(a.outcome.mesh, find_memory_order(a.outcome.mesh), options(), preservation);
  a.outcome.points = vertex_points(a.outcome.mesh);
  a.outcome.faces = triangles_of(a.outcome.mesh);
  return a;
}

/// A washer with a hole of radius 1.
test::Triangles washer() {
  return test::turned({{1, 0}, {10, 0}, {10, 2}, {1, 2}}, 48);
}

void expect_as_asked(const Adapted& a, const test::Triangles& t, double length) {
  EXPECT_EQ(a.outcome.result.shortened, 0) << length;
  const test::Outcome once = test::remeshed(t, length, options());
  ASSERT_EQ(a.outcome.faces, once.faces) << length;
  EXPECT_EQ(a.outcome.points, once.points) << length;
}

TEST(ShorterLengths, RodsThatAreThinForTheLengthStayRound) {
  for (const double length : {1.5, 2.6}) {
    const Adapted rod = adapted(test::drum(32, 30), length);
    EXPECT_TRUE(rod.measures().preservation.holds()) << length;
    EXPECT_GT(rod.outcome.result.shortened, 0) << length;
    EXPECT_LT(rod.outcome.mesh.n_faces(), 7.5 * rod.asked) << length;  // 6 times, and those of whole edges
    EXPECT_GT(rod.volume_change(), -.1 - .05 * length) << length;
    EXPECT_GT(rod.measures().quality.min_angle.min, 25) << length;
  }
}

TEST(ShorterLengths, HolesThatAreSmallForTheLengthStayRound) {
  for (const double length : {1.5, 2., 3., 4.}) {
    const Adapted a = adapted(washer(), length);
    EXPECT_TRUE(a.measures().preservation.holds()) << length;
    EXPECT_GT(a.outcome.result.shortened, 0) << length;
    EXPECT_LT(a.outcome.mesh.n_faces(), 6 * a.asked) << length;
    EXPECT_LT(a.measures().preservation.crease_loss, .3) << length;  // 1 of a hole with two sides
  }
}

TEST(ShorterLengths, CornersAndSmoothPartsThatAreResolvedTakeNoShorterEdges) {
  for (const double length : {3., 6.}) {
    const test::Triangles bar = test::drum(6, 20);
    const Adapted a = adapted(bar, length);
    EXPECT_EQ(a.outcome.result.shortened, 0) << length;
    EXPECT_NEAR(a.volume_change(), 0, 1e-12) << length;
  }
  for (const double length : {.6}) expect_as_asked(adapted(washer(), length), washer(), length);
}

TEST(ShorterLengths, ResultsComeNoFartherFromTheInput) {
  for (const int sides : {10, 24})
    for (const double length : {2., 4.}) {
      const test::Triangles bar = test::drum(sides, 12);
      const test::Outcome once = test::remeshed(bar, length, options());
      const double before = test::volume(once.points, once.faces) / test::volume(bar.points, bar.faces) - 1;
      const Adapted a = adapted(bar, length);
      EXPECT_TRUE(a.measures().preservation.holds()) << sides << " " << length;
      EXPECT_LE(std::abs(a.volume_change()), std::abs(before) + .005) << sides << " " << length;
    }
}

/// A flat ellipsoid of even faces.
test::Triangles lentil() {
  test::Triangles t = test::sphere(4, 0, 1);
  t.points.row(1) *= .25;
  return t;
}

TEST(ShorterLengths, OnlyBodiesWhoseFacetsAreMeantTakeThem) {
  for (const double times_natural : {3., 5., 8.}) {
    const double length = times_natural * test::natural(lentil());
    expect_as_asked(adapted(lentil(), length), lentil(), length);
  }
}

TEST(ShorterLengths, NotWhereTheyWouldTakeTooManyFaces) {
  const Adapted a = adapted(test::drum(32, 30), 12);
  EXPECT_TRUE(a.measures().preservation.holds());
  EXPECT_EQ(a.outcome.result.shortened, 0);
}

TEST(ShorterLengths, NotWithAMaximumDistanceThatIsKept) {
  const test::Triangles rod = test::drum(32, 30);
  const Adapted a = adapted(rod, 2.6, {.max_distance = .5});
  EXPECT_EQ(a.outcome.result.shortened, 0);
}

}  // namespace hooke::shorter_lengths_test
