#include "hooke/remesh/remesh.h"

#include <gtest/gtest.h>

#include "hooke/geometry/triangle.h"
#include "remeshed.h"
#include "solids.h"

namespace hooke {
namespace {

using test::natural, test::Outcome, test::remeshed;

double wave(double x, double y) {
  return .12 * std::sin(4 * x) * std::cos(3 * y);
}

/// Steep flanks: what the filter keeps there costs angles.
double mountain(double x, double y) {
  return .6 * std::exp(-12 * ((x - .5) * (x - .5) + (y - .4) * (y - .4)));
}

/// Sheared into equilateral triangles in the plane below.
test::Triangles equilateral_grid(int n, double (*height)(double, double), double jitter) {
  test::Triangles t = test::grid(n, height, jitter);
  for (auto x : t.points.colwise()) x = Vec3(x[0] - .5 * x[1], std::sqrt(.75) * x[1], x[2]);
  return t;
}

/// An ellipsoid with axes 1, .92 and .88.
test::Triangles ellipsoid(int levels, double jitter) {
  test::Triangles t = test::sphere(levels, jitter);
  t.points.row(1) *= .92;
  t.points.row(2) *= .88;
  return t;
}

double largest_move(const test::Triangles& t, const Outcome& o) {
  return (o.points - t.points).colwise().norm().maxCoeff();
}

TEST(DoNoHarm, NearRegularMeshesKeepTheirLeastAngleAndTheirPlaces) {
  for (const test::Triangles& t :
       {test::sphere(1), test::sphere(2), test::sphere(3), test::sphere(3, .08, 3), ellipsoid(2, 0),
        ellipsoid(3, .05), equilateral_grid(9, wave, .1), equilateral_grid(12, test::flat, .08),
        test::grid(8, test::flat, .05), test::cube()}) {
    const Outcome o = remeshed(t);
    SCOPED_TRACE(least_angle(t.points, t.faces));
    EXPECT_TRUE(o.result.near_regular);
    EXPECT_GE(least_angle(o.points, t.faces), least_angle(t.points, t.faces));
    EXPECT_LT(largest_move(t, o), .2 * natural(t));
  }
}

TEST(DoNoHarm, NearRegularMeshesStillGetMoreEqualEdges) {
  const test::Triangles t = test::sphere(3, .08, 3);
  const Connectivity c = test::connect(t);
  const TargetLengths targets = spread_target_lengths(c, std::vector<double>(t.points.cols(), 1));
  EXPECT_LT(relative_edge_deviation(remeshed(t).points, c.edges, targets),
            .9 * relative_edge_deviation(t.points, c.edges, targets));
}

TEST(DoNoHarm, NoLeastAngleFalls) {
  for (unsigned seed = 1; seed <= 4; ++seed)
    for (const test::Triangles& t : {test::grid(12, mountain, .1, seed), test::grid(12, mountain, .3, seed),
                                     test::sphere(2, .35, seed)}) {
      const Outcome o = remeshed(t);
      EXPECT_FALSE(o.result.near_regular && least_angle(t.points, t.faces) < 35);
      EXPECT_GE(least_angle(o.points, t.faces), least_angle(t.points, t.faces));
    }
}

TEST(DoNoHarm, AnglesAreSpentWhereLengthsAreToDiffer) {
  const test::Triangles t = test::sphere(3);
  TriMesh mesh = test::with_length(t, natural(t));
  VProp<double> length(mesh, target_length_property);
  for (const auto v : mesh.vertices()) length[v] *= 2.5 + 1.5 * mesh.point(v)[2];
  EXPECT_FALSE(remesh(mesh, {}).near_regular);
  EXPECT_LT(least_angle(positions(mesh), t.faces), least_angle(t.points, t.faces) - 1);
  EXPECT_GT((positions(mesh) - t.points).colwise().norm().maxCoeff(), natural(t));
}

}  // namespace
}  // namespace hooke
