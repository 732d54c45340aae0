#include "hooke/constraints/constraints.h"

#include <gtest/gtest.h>

#include "remeshed.h"
#include "solids.h"

namespace hooke {
namespace {

/// Two uneven bumps side by side whose vertices on the common side x = 1 have the same places, but other ids.
test::Triangles seamed(int n) {
  const auto bump = [](double x, double y) { return .3 * std::sin(3 * x) * std::cos(2 * y); };
  const test::Triangles left = test::grid(n, bump, .35, 1);
  test::Triangles right = test::grid(n, bump, .35, 2);
  right.points.row(0) = (2 - right.points.row(0).array()).matrix().eval();
  for (Triangle& f : right.faces) std::swap(f[1], f[2]);  // it was mirrored
  return test::both(left, right);
}

TEST(CoincidentBoundary, AreTheVerticesOnBothSidesOfASeam) {
  const test::Triangles t = seamed(4);
  const std::vector<int> found = coincident_boundary_vertices(t.points, test::connect(t));
  std::vector<int> expected;
  for (int v = 0; v < t.points.cols(); ++v)
    if (t.points(0, v) == 1) expected.push_back(v);
  EXPECT_EQ(found, expected);
  EXPECT_EQ(found.size(), 10u);
}

TEST(CoincidentBoundary, IsNoneWhereOnlyOneSideIsABoundaryOrThePlacesDiffer) {
  test::Triangles apart = seamed(4);
  for (int v = 0; v < 25; ++v) apart.points(2, v) += 1e-12;
  EXPECT_TRUE(coincident_boundary_vertices(apart.points, test::connect(apart)).empty());
  const test::Triangles t = test::both(test::tetrahedron(), test::tetrahedron());
  EXPECT_TRUE(coincident_boundary_vertices(t.points, test::connect(t)).empty());
}

TEST(CoincidentBoundary, StaysClosedToTheLastBit) {
  const test::Triangles t = seamed(8);
  const std::vector<int> seam = coincident_boundary_vertices(t.points, test::connect(t));
  ASSERT_FALSE(seam.empty());
  for (ConnectivityMode mode : {ConnectivityMode::fixed, ConnectivityMode::flip}) {
    RemeshOptions options;
    options.connectivity = mode;
    for (BoundaryRule rule : {BoundaryRule::slide, BoundaryRule::free}) {
      options.constraints.boundary = rule;
      const test::Outcome o = test::remeshed(t, options);
      for (int v : seam) EXPECT_EQ(o.points.col(v), t.points.col(v)) << v;
      EXPECT_NE(o.points, t.points);
    }
  }
}

TEST(CoincidentBoundary, KeepsItsVerticesInModeAdaptAndNewOnesLieBetweenThem) {
  const test::Triangles t = seamed(8);
  const std::vector<int> seam = coincident_boundary_vertices(t.points, test::connect(t));
  RemeshOptions options;
  options.connectivity = ConnectivityMode::adapt;
  for (double length : {.5, 1.}) {
    const test::Outcome o = test::remeshed(t, length * test::natural(t), options);
    const auto is_there = [&](const Vec3& place) {
      return (o.points.colwise() - place).colwise().squaredNorm().minCoeff() == 0;
    };
    for (int v : seam) EXPECT_TRUE(is_there(t.points.col(v))) << v;
    const Connectivity c = make_connectivity(static_cast<int>(o.points.cols()), o.faces);
    for (size_t e = 0; e < c.edges.size(); ++e) {
      const Vec3 a = o.points.col(c.edges[e][0]);
      if (!c.is_boundary_edge(static_cast<int>(e)) || std::abs(a.x() - 1) > 1e-9) continue;
      double distance = 1;
      for (size_t i = 0; i < seam.size(); ++i)
        for (size_t j = 0; j < i; ++j) {
          const Vec3 p = t.points.col(seam[i]), d = t.points.col(seam[j]) - p;
          if (d.y() == 0 || std::abs(d.y()) > .2) continue;  // neighbours on the seam are .125 apart
          const double s = std::clamp((a - p).dot(d) / d.squaredNorm(), 0., 1.);
          distance = std::min(distance, (a - p - s * d).norm());
        }
      EXPECT_LT(distance, 1e-12);
    }
  }
}

}  // namespace
}  // namespace hooke
