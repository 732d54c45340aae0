#include "hooke/constraints/constraints.h"

#include <gtest/gtest.h>

#include "hooke/constraints/feature_curves.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/wedges.h"
#include "hooke/remesh/options.h"
#include "support/crease_solids.h"
#include "support/remeshed.h"
#include "support/scene.h"
#include "support/solids.h"

namespace hooke::constraints_test {

/// Two uneven bumps that share the boundary x = 1, where vertices have the same positions but different ids.
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
    const Adjacency c = make_adjacency(static_cast<int>(o.points.cols()), o.faces);
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

Constraints constraints_of(const test::Triangles& t, const ConstraintOptions& options = {}) {
  return find_constraints(t.points, test::connect(t), options);
}

long count_of(const Constraints& c, Freedom freedom) {
  return std::ranges::count(c.freedom, freedom);
}

/// A fan of triangles about vertex 0 with the boundary on the unit circle.
test::Triangles disk(int triangles) {
  test::Triangles t{Mat3X::Zero(3, triangles + 1), {}};
  for (int i = 0; i < triangles; ++i) {
    const double angle = 2 * std::numbers::pi * i / triangles;
    t.points.col(i + 1) = Vec3(std::cos(angle), std::sin(angle), 0);
    t.faces.push_back({0, i + 1, (i + 1) % triangles + 1});
  }
  return t;
}

/// A disk of 24 triangles with one tip, the only corner, at vertex 5.
test::Triangles drop() {
  test::Triangles t = disk(24);
  t.points.col(5) *= 1.25;
  return t;
}

TEST(Constraints, ASquareHasFourCornersAndFourSides) {
  const Constraints c = constraints_of(test::moved(test::grid(6, test::flat)));
  EXPECT_EQ(count_of(c, Freedom::fixed), 4);
  EXPECT_EQ(count_of(c, Freedom::curve), 4 * 5);
  EXPECT_EQ(count_of(c, Freedom::surface), 25);
  ASSERT_EQ(c.curves.size(), 4u);
  for (const Curve& curve : c.curves) {
    EXPECT_FALSE(curve.closed);
    EXPECT_EQ(curve.segment_count(), 6);
  }
}

TEST(Constraints, CornersAreSeenIn3D) {
  // Seen from above the boundary is straight at x = 1/2; in space it turns by 90 degrees there.
  const auto roof = [](double x, double) { return std::abs(x - .5); };
  EXPECT_EQ(count_of(constraints_of(test::grid(4, roof)), Freedom::fixed), 6);
  const auto flat_roof = [](double x, double) { return .3 * std::abs(x - .5); };  // 33 degrees
  EXPECT_EQ(count_of(constraints_of(test::grid(4, flat_roof)), Freedom::fixed), 4);
}

TEST(Constraints, TheCornerAngleIsTheTurnOfTheBoundary) {
  EXPECT_EQ(count_of(constraints_of(disk(10)), Freedom::fixed), 10);  // 36 degrees
  EXPECT_EQ(count_of(constraints_of(disk(11)), Freedom::fixed), 0);   // 32.7
}

TEST(Constraints, ALoopWithoutCornersIsAClosedCurve) {
  const Constraints c = constraints_of(disk(20));
  ASSERT_EQ(c.curves.size(), 1u);
  EXPECT_TRUE(c.curves[0].closed);
  EXPECT_EQ(c.curves[0].segment_count(), 20);
  EXPECT_EQ(count_of(c, Freedom::curve), 20);
  EXPECT_EQ(c.freedom[0], Freedom::surface);
}

TEST(Constraints, ALoopWithOneCornerIsOpenAndEndsWhereItBegins) {
  const test::Triangles t = drop();
  const Constraints c = constraints_of(t);
  EXPECT_EQ(count_of(c, Freedom::fixed), 1);
  EXPECT_EQ(c.freedom[5], Freedom::fixed);
  ASSERT_EQ(c.curves.size(), 1u);
  const Mat3X& p = c.curves[0].points;
  EXPECT_FALSE(c.curves[0].closed);
  ASSERT_EQ(p.cols(), 25);
  EXPECT_EQ(p.col(0), t.points.col(5));
  EXPECT_EQ(p.col(24), t.points.col(5));
}

TEST(Constraints, EveryVertexStartsAtItsOwnPlaceOnItsCurve) {
  for (const test::Triangles& t : {test::grid(5, test::paraboloid), disk(15), drop()}) {
    const Constraints c = constraints_of(t);
    for (size_t v = 0; v < c.freedom.size(); ++v) {
      if (c.freedom[v] != Freedom::curve) {
        EXPECT_EQ(c.curve[v], -1);
        continue;
      }
      const Vec3 x = t.points.col(static_cast<Eigen::Index>(v));
      const Curve& curve = c.curves[c.curve[v]];
      EXPECT_EQ(curve.points.col(c.segment[v]), x);
      EXPECT_EQ(project_to_curve(curve, x, c.segment[v]).point, x);
    }
  }
}

TEST(Constraints, EveryLoopHasItsOwnCurves) {
  test::Triangles ring = test::grid(6, test::flat);
  std::erase_if(ring.faces, [&](const Triangle& t) {  // a hole in the middle
    const Vec3 middle = (ring.points.col(t[0]) + ring.points.col(t[1]) + ring.points.col(t[2])) / 3;
    return (middle - Vec3(.5, .5, 0)).lpNorm<Eigen::Infinity>() < 1. / 6;
  });
  test::Triangles round = disk(20);
  round.points.row(2).array() += 1;
  const Constraints c = constraints_of(test::both(ring, round));
  EXPECT_EQ(c.curves.size(), 4u + 4u + 1u);
  EXPECT_EQ(count_of(c, Freedom::fixed), 4 + 4 + 1);  // and the vertex in the middle of the hole
}

TEST(Constraints, AFixedBoundaryStandsStillAndAFreeOneDoesNot) {
  const test::Triangles t = test::grid(6, test::flat);
  const Constraints fixed = constraints_of(t, {.boundary = BoundaryRule::fixed});
  EXPECT_EQ(count_of(fixed, Freedom::fixed), 24);
  EXPECT_EQ(count_of(fixed, Freedom::curve), 0);
  const Constraints free = constraints_of(t, {.boundary = BoundaryRule::free});
  EXPECT_EQ(count_of(free, Freedom::surface), 49);
}

TEST(Constraints, GivenVerticesStandStillUnderEveryRule) {
  for (BoundaryRule rule : {BoundaryRule::slide, BoundaryRule::fixed, BoundaryRule::free}) {
    const Constraints c = constraints_of(test::grid(6, test::flat),
                                         {.boundary = rule, .fixed_vertices = {3, 24}});  // 3: on boundary
    EXPECT_EQ(c.freedom[3], Freedom::fixed);
    EXPECT_EQ(c.freedom[24], Freedom::fixed);
    EXPECT_EQ(c.curves.size(), rule == BoundaryRule::slide ? 4u : 0u);
  }
}

TEST(Constraints, VerticesWithoutFacesStandStill) {
  test::Triangles t = test::sphere(1);
  t.points.conservativeResize(3, t.points.cols() + 1);
  t.points.rightCols(1).setZero();
  for (BoundaryRule rule : {BoundaryRule::slide, BoundaryRule::fixed, BoundaryRule::free}) {
    const Constraints c = constraints_of(t, {.boundary = rule});
    EXPECT_EQ(c.freedom.back(), Freedom::fixed);
    EXPECT_EQ(count_of(c, Freedom::fixed), 1);
  }
}

/// Projects points near segments up to two away from the start of the search and compares with the search
/// over all segments.
void expect_closest(const Curve& curve, double distance) {
  const Mat3X shift = test::random_vectors(400, distance, 9);
  for (int i = 0; i < 400; ++i) {
    const int n = curve.segment_count();
    const int start = i % n;
    const int near = curve.closed ? (start + i % 5 - 2 + n) % n : std::clamp(start + i % 5 - 2, 0, n - 1);
    const Vec3 x = curve.points.col(near) + shift.col(i);
    const CurveProjection projection = project_to_curve(curve, x, start);
    EXPECT_NEAR((projection.point - x).norm(), test::distance_to(curve, x), 1e-13) << i;
    EXPECT_LT(test::distance_to(curve, projection.point), 1e-14) << i;
    EXPECT_NEAR(projection.tangent.norm(), 1, 1e-14);
    EXPECT_GE(projection.segment, 0);
    EXPECT_LT(projection.segment, n);
  }
}

TEST(ProjectToCurve, EqualsTheSearchOverAllSegments) {
  expect_closest(constraints_of(test::moved(disk(40))).curves[0], .15);
  const auto wave = [](double x, double y) { return .08 * std::sin(7 * x + y); };
  for (const Curve& curve : constraints_of(test::grid(30, wave)).curves) expect_closest(curve, .05);
}

TEST(ProjectToCurve, TangentsTurnWithoutAJumpAtThePoints) {
  const Constraints constraints = constraints_of(disk(20));
  const Curve& curve = constraints.curves[0];
  const Vec3 along = (curve.points.col(4) - curve.points.col(2)).normalized();
  for (double step : {-1e-9, 0., 1e-9}) {
    const CurveProjection projection = project_to_curve(curve, curve.points.col(3) + step * along, 3);
    EXPECT_LT((projection.tangent - along).norm(), 1e-7);
  }
}

TEST(ProjectToCurve, StaysWithinAnOpenCurve) {
  const Constraints constraints = constraints_of(test::grid(6, test::flat));
  for (const Curve& curve : constraints.curves) {
    const Vec3 first = curve.points.col(0), last = curve.points.rightCols(1);
    EXPECT_EQ(project_to_curve(curve, last + 2 * (last - first), 1).point, last);
    EXPECT_EQ(project_to_curve(curve, first - 2 * (last - first), 4).point, first);
  }
}

Constraints creased(const test::Triangles& t) {
  Adjacency c = test::connect(t);
  split_wedges(c, test::bent_edges(t.points, t.faces));
  return find_constraints(t.points, c, {});
}

TEST(Constraints, AnEvenCreaseKeepsItsVerticesAtBends) {
  const Constraints even = creased(test::cylinder(40, .05));
  EXPECT_EQ(count_of(even, Freedom::fixed), 80);
  for (int v = 0; v < static_cast<int>(even.freedom.size()); ++v)
    EXPECT_EQ(even.at_bend(v), even.freedom[v] == Freedom::fixed);
  ASSERT_EQ(even.curves.size(), 2u);
  for (const Curve& curve : even.curves) EXPECT_TRUE(curve.closed);  // they break no curve

  const Constraints uneven = creased(test::cylinder(40, .2));
  EXPECT_EQ(count_of(uneven, Freedom::fixed), 0);
  EXPECT_EQ(count_of(uneven, Freedom::curve), 80);
}

TEST(Constraints, LinesOfRoundedEdgesHaveNoCornersButWhereTheyEndOrMeet) {
  const test::Triangles t = test::grid(6, test::flat);
  Adjacency c = test::connect(t);
  std::vector<Edge> stairs;
  for (const int v : {15, 23, 31}) {  // 7 vertices a row
    stairs.push_back({v, v + 1});
    stairs.push_back({v + 1, v + 8});
  }
  split_wedges(c, stairs);
  ConstraintOptions options{.boundary = BoundaryRule::free};
  EXPECT_EQ(count_of(find_constraints(t.points, c, options), Freedom::fixed), 7);
  options.rounded_edges = stairs;
  const Constraints smooth = find_constraints(t.points, c, options);
  EXPECT_EQ(count_of(smooth, Freedom::fixed), 2);
  EXPECT_EQ(count_of(smooth, Freedom::curve), 5);
  EXPECT_EQ(smooth.curves.size(), 1u);
  options.rounded_edges.pop_back();  // a vertex of another line beside it
  EXPECT_EQ(count_of(find_constraints(t.points, c, options), Freedom::fixed), 3);
}

TEST(Constraints, OnStraightCreasesVerticesSlide) {
  const Constraints c = creased(test::step_block(3));
  EXPECT_EQ(count_of(c, Freedom::fixed), 12);
  for (size_t v = 0; v < c.freedom.size(); ++v) EXPECT_FALSE(c.at_bend(static_cast<int>(v)));
}

}  // namespace hooke::constraints_test
