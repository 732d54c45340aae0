#include "hooke/integrator/angle_springs.h"

#include <gtest/gtest.h>

#include "hooke/core/parallel.h"
#include "hooke/filter/retraction.h"
#include "hooke/geometry/triangle.h"
#include "hooke/integrator/lbfgs.h"
#include "hooke/integrator/relaxation.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/springs/target_lengths.h"
#include "support/scene.h"

namespace hooke::angle_springs_test {

/// Relaxes the springs; angle optimisation starts from their equilibrium.
void relax(test::Scene& s) {
  Relaxation r = s.relaxation();
  relax_lbfgs(r, IntegrationOptions{}, LbfgsOptions{}, nullptr);
}

AngleSpringResult angle_optimised(test::Scene& s, const AngleSpringOptions& options = {},
                                  const Observer& observer = nullptr) {
  Relaxation r = s.relaxation();
  return raise_angles(r, s.targets, options, observer);
}

/// Irregular connectivity, whose springs rest with small angles: a disk of triangles with a vertex of valence
/// 3 in every fourth of them.
test::Triangles irregular(unsigned seed = 11) {
  test::Triangles t = test::grid(8, test::flat, .25, seed);
  test::split_at_centres(t, 5, 4);
  return t;
}

double angle_of(const test::Scene& s) {
  return min_angle(s.positions.points, s.adjacency.faces);
}
/// Of a mesh on the unit sphere.
int inward_faces(const test::Scene& s) {
  return static_cast<int>(std::ranges::count_if(s.adjacency.faces, [&](const Triangle& t) {
    return test::area_vector(s.positions.points, t).dot(s.positions.points.col(t[0])) <= 0;
  }));
}
double deviation_of(const test::Scene& s) {
  return relative_edge_deviation(s.positions.points, s.adjacency.edges, s.targets);
}

TEST(LeastAngle, IsThatOfGeometry) {
  const test::Triangles e = test::equilateral();
  EXPECT_NEAR(min_angle(e.points, e.faces), 60, 1e-12);
  const test::Triangles c = test::moved(test::cube(), 7);
  for (const Triangle& t : c.faces) EXPECT_NEAR(max_cotangent(c.points, t), 1, 1e-14);
  const test::Triangles sliver = test::triangles({{0, 0, 0}, {1, 0, 0}, {.5, 0, 0}}, {{0, 1, 2}});
  EXPECT_EQ(min_angle(sliver.points, sliver.faces), 0);
}

TEST(RelativeEdgeDeviation, IsTheStandardDeviationInPartsOfTheTargets) {
  const test::Triangles c = test::cube();
  const Adjacency adjacency = test::connect(c);
  TargetLengths targets = spread_target_lengths(adjacency, std::vector<double>(8, 2));
  const double mean = (12 + 6 * std::sqrt(2)) / 18;
  const double variance = (12 * (1 - mean) * (1 - mean) + 6 * std::pow(std::sqrt(2) - mean, 2)) / 18;
  EXPECT_NEAR(relative_edge_deviation(c.points, adjacency.edges, targets), std::sqrt(variance) / 2, 1e-14);
  std::vector<double> lengths;
  for (const auto& [a, b] : adjacency.edges)
    lengths.push_back(3 * (c.points.col(a) - c.points.col(b)).norm());
  targets.edge = lengths;
  EXPECT_NEAR(relative_edge_deviation(c.points, adjacency.edges, targets), 0, 1e-15);
}

TEST(AngleSprings, RaiseTheLeastAngleAndNeverTheEdgeDeviation) {
  test::Scene s(irregular(), test::to_ground);
  relax(s);
  const double angle = angle_of(s), deviation = deviation_of(s);
  ASSERT_LT(angle, 30);
  const AngleSpringResult result = angle_optimised(s);
  EXPECT_EQ(result.min_angle_before, angle);
  EXPECT_EQ(result.edge_error_before, deviation);
  EXPECT_EQ(result.min_angle_after, angle_of(s));
  EXPECT_EQ(result.edge_error_after, deviation_of(s));
  EXPECT_GT(result.min_angle_after, angle + 1);
  EXPECT_LE(result.edge_error_after, deviation);
}

TEST(AngleSprings, AreNeverWorseThanTheStart) {
  AngleSpringOptions options;
  options.keep_within = 90;  // so that only the start bounds what is kept
  for (unsigned seed = 1; seed <= 20; ++seed)
    for (bool at_rest : {true, false}) {
      test::Scene s(test::sphere(2, .45, seed), test::to_unit_sphere);
      if (at_rest) relax(s);
      const double angle = angle_of(s), deviation = deviation_of(s);
      const int folded = inward_faces(s);
      angle_optimised(s, options);
      EXPECT_GE(angle_of(s), angle) << seed;
      EXPECT_LE(deviation_of(s), deviation) << seed;
      EXPECT_LE(inward_faces(s), folded) << seed;
      EXPECT_LT((s.positions.points.colwise().norm().array() - 1).abs().maxCoeff(), 1e-15);
    }
}

TEST(AngleSprings, AreNeverWorseThanTheStartWhereConnectivityBinds) {
  AngleSpringOptions high;  // thresholds that cannot be met: angles improve at the expense of others
  high.first_threshold = 45;
  high.last_threshold = 50;
  high.keep_within = 90;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    test::Scene s(irregular(seed), test::to_ground);
    relax(s);
    const double angle = angle_of(s);
    EXPECT_GE(angle_optimised(s, high).min_angle_after, angle);
    EXPECT_GE(angle_of(s), angle);
    angle_optimised(s, high);
    EXPECT_GE(angle_of(s), angle);
  }
}

TEST(AngleSprings, LeaveGoodAnglesAlone) {
  test::Scene s = test::sphere_scene(0);
  const SurfacePositions before = s.positions;
  EXPECT_EQ(angle_optimised(s).stages, 0);
  EXPECT_TRUE(test::same(s.positions, before));
}

TEST(AngleSprings, MoveOnlyWhatLiesAroundBadFaces) {
  test::Triangles t = test::grid(20, test::flat);
  t.points.col(21 * 4 + 4) += Vec3(.034, .016, 0);  // one bad ring near a corner
  test::Scene s(t, test::to_ground);
  ASSERT_LT(angle_of(s), 20);
  angle_optimised(s);
  for (Eigen::Index v = 0; v < t.points.cols(); ++v)
    if (t.points(0, v) > .6 || t.points(1, v) > .6) {
      EXPECT_EQ(s.positions.points.col(v), t.points.col(v));
    }
  EXPECT_GT(angle_of(s), 20);
}

TEST(AngleSprings, RestoreTheTermsAndStopWhenAskedTo) {
  test::Scene s(irregular(), test::to_ground);
  relax(s);
  const double angle = angle_of(s), deviation = deviation_of(s);
  Relaxation r = s.relaxation();
  const AngleSpringResult result =
      raise_angles(r, s.targets, {}, [](const Progress& p) { return p.step < 3; });
  EXPECT_EQ(r.terms.angle, 0);
  EXPECT_EQ(r.terms.altitude, 1);
  EXPECT_TRUE(result.interrupted);
  EXPECT_LE(result.sweeps, 5);
  EXPECT_GE(angle_of(s), angle);
  EXPECT_LE(deviation_of(s), deviation);
}

TEST(AngleSprings, OneThreadAndTwoGiveTheSameBits) {
  std::vector<SurfacePositions> results;
  for (int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    test::Scene s(irregular(), test::to_ground);
    relax(s);
    angle_optimised(s);
    results.push_back(s.positions);
  }
  EXPECT_TRUE(test::same(results[0], results[1]));
}

}  // namespace hooke::angle_springs_test
