#include "hooke/measure/quality.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/curvature.h"
#include "support/solids.h"

namespace hooke::quality_test {

Quality measure(const test::Triangles& t, const std::vector<double>& targets = {}) {
  return measure_quality(t.points, test::connect(t), targets);
}

TEST(TriangleShape, EquilateralIsPerfect) {
  const test::Triangles t = test::equilateral();
  const TriangleShape s = measure_triangle(t.points.col(0), t.points.col(1), t.points.col(2));
  EXPECT_NEAR(s.min_angle, 60, 1e-13);
  EXPECT_NEAR(s.max_angle, 60, 1e-13);
  for (double one : {s.shape, s.radius_ratio, s.aspect_ratio, s.edge_ratio}) EXPECT_NEAR(one, 1, 1e-14);
}

TEST(TriangleShape, RightTriangle345) {
  const TriangleShape s = measure_triangle({0, 0, 0}, {3, 0, 0}, {0, 4, 0});
  EXPECT_NEAR(s.min_angle, std::atan2(3, 4) * 180 / std::numbers::pi, 1e-13);
  EXPECT_NEAR(s.max_angle, 90, 1e-13);
  EXPECT_NEAR(s.shape, 4 * std::numbers::sqrt3 * 6 / 50, 1e-14);
  EXPECT_NEAR(s.radius_ratio, 2.5 / 2, 1e-14);  // R = 2.5, r = 1
  EXPECT_NEAR(s.aspect_ratio, 5 / (2 * std::numbers::sqrt3), 1e-14);
  EXPECT_NEAR(s.edge_ratio, 5. / 3, 1e-14);
}

TEST(TriangleShape, SliverAnglesKeepTheirDigits) {
  const double h = 1e-12;
  const TriangleShape s = measure_triangle({0, 0, 0}, {2, 0, 0}, {1, h, 0});
  EXPECT_NEAR(s.min_angle, h * 180 / std::numbers::pi, 1e-13 * h * 180);
  EXPECT_NEAR(180 - s.max_angle, 2 * h * 180 / std::numbers::pi, 1e-13);
}

TEST(TriangleShape, CoincidentCornersHaveNoAngleAndNoFiniteRatio) {
  for (const Vec3& c : {Vec3(1, 0, 0), Vec3(-1, 2, -3), Vec3(0, 0, 0)}) {
    const TriangleShape s = measure_triangle({0, 0, 0}, {0, 0, 0}, c);
    EXPECT_EQ(s.min_angle, 0);
    EXPECT_EQ(s.shape, 0);
    EXPECT_FALSE(std::isfinite(s.radius_ratio) || std::isfinite(s.aspect_ratio) ||
                 std::isfinite(s.edge_ratio));
  }
}

TEST(Quality, OfATetrahedron) {
  const Quality q = measure(test::tetrahedron());
  EXPECT_NEAR(q.min_angle.min, 60, 1e-12);
  EXPECT_NEAR(q.shape.min, 1, 1e-14);
  EXPECT_NEAR(q.edge_length.mean, std::sqrt(8.), 1e-14);
  EXPECT_NEAR(q.edge_length.std, 0, 1e-14);
  EXPECT_EQ(q.edge_length.count, 6u);
  EXPECT_EQ(q.min_angle.count, 4u);
  EXPECT_NEAR(q.extent.area, 8 * std::numbers::sqrt3, 1e-13);
  EXPECT_NEAR(*q.extent.volume, 8. / 3, 1e-14);
  EXPECT_EQ(q.folded_edges, 4u + 2u);  // dihedral of 70.5 degrees: the normals oppose each other
}

TEST(Quality, OfACube) {
  const Quality q = measure(test::cube());
  EXPECT_NEAR(q.min_angle.max, 45, 1e-13);
  EXPECT_NEAR(q.max_angle.min, 90, 1e-13);
  EXPECT_EQ(q.folded_edges, 0u);
  EXPECT_EQ(q.degenerate_faces, 0u);
  EXPECT_EQ(q.self_intersections, 0u);
  EXPECT_NEAR(q.extent.area, 6, 1e-14);
  EXPECT_NEAR(*q.extent.volume, 1, 1e-15);
  EXPECT_EQ(q.extent.lower, Vec3(0, 0, 0));
  EXPECT_EQ(q.extent.upper, Vec3(1, 1, 1));
  EXPECT_DOUBLE_EQ(q.extent.diagonal, std::numbers::sqrt3);
}

TEST(Quality, LengthErrorIsRelativeToEachEdgesTarget) {
  const test::Triangles t = test::triangles({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, {{0, 1, 2}});
  const Quality q = measure(t, {2, 5, 5});  // the edges are 3, 5 and 4 long
  EXPECT_DOUBLE_EQ(q.length_error.max, .5);
  EXPECT_DOUBLE_EQ(q.length_error.median, 0);
  EXPECT_DOUBLE_EQ(q.length_error.min, -.2);
  EXPECT_EQ(measure(t).length_error.count, 0u);
}

TEST(Quality, OpenMeshHasNoVolume) {
  EXPECT_FALSE(measure(test::equilateral()).extent.volume);
}

TEST(Quality, FoldedEdgeIsSeen) {
  const test::Triangles t =
      test::triangles({{0, 0, 0}, {1, 0, 0}, {.5, 1, 0}, {.5, .8, .1}}, {{0, 1, 2}, {1, 0, 3}});
  EXPECT_EQ(measure(t).folded_edges, 1u);
}

TEST(Quality, FaceWithoutAreaIsDegenerateAndWorst) {
  test::Triangles t = test::grid(3, test::flat);
  t.points.col(5) = t.points.col(4);
  const Quality q = measure(t);
  EXPECT_EQ(q.degenerate_faces, 2u);
  EXPECT_EQ(q.radius_ratio.non_finite, 2u);
  ASSERT_FALSE(q.worst_faces.empty());
  EXPECT_EQ(q.worst_faces[0].min_angle, 0);
}

TEST(Quality, FoldsAtCreasesAreMeant) {
  const test::Triangles wedge =
      test::triangles({{0, 0, 0}, {2, 0, 0}, {1, 2, .1}, {1, 2, -.1}, {1, -2, 0}}, {{0, 1, 2}, {1, 0, 3}});
  const Adjacency c = test::connect(wedge);
  const MeasuredSurface surface(wedge.points, c);
  Quality q = measure_quality(surface, {});
  EXPECT_EQ(q.folded_edges, 1u);
  apply_creases(q, surface, {{1, 0}});
  EXPECT_EQ(q.folded_edges, 0u);
}

TEST(Quality, WorstFacesAreThoseOfEachRegionInOrder) {
  const test::Triangles t = test::sphere(2, .3);
  const Quality q = measure(t);
  ASSERT_EQ(q.worst_faces.size(), 10u);
  EXPECT_EQ(q.worst_faces[0].min_angle, q.min_angle.min);
  for (size_t k = 1; k < 10; ++k) EXPECT_LE(q.worst_faces[k - 1].min_angle, q.worst_faces[k].min_angle);
  std::set<int> taken;
  for (const WorstFace& w : q.worst_faces) {
    for (int v : w.vertices) EXPECT_TRUE(taken.insert(v).second);
    EXPECT_EQ(w.vertices, t.faces[w.face]);
    const Vec3 centre =
        (t.points.col(w.vertices[0]) + t.points.col(w.vertices[1]) + t.points.col(w.vertices[2])) / 3;
    EXPECT_EQ(w.centre, centre);
  }
}

TEST(Quality, RigidMotionAndScaleChangeOnlyWhatTheyMust) {
  const test::Triangles t = test::sphere(2, .3);
  const double scale = 1000;
  const Quality a = measure(t), b = measure(test::moved(t, scale));
  EXPECT_NEAR(b.min_angle.min, a.min_angle.min, 1e-9);
  EXPECT_NEAR(b.max_angle.p95, a.max_angle.p95, 1e-9);
  EXPECT_NEAR(b.shape.mean, a.shape.mean, 1e-12);
  EXPECT_NEAR(b.radius_ratio.max, a.radius_ratio.max, 1e-9 * a.radius_ratio.max);
  EXPECT_NEAR(b.edge_length.std, a.edge_length.std * scale, 1e-9);
  EXPECT_NEAR(b.extent.area, a.extent.area * scale * scale, 1e-9 * b.extent.area);
  EXPECT_NEAR(*b.extent.volume, *a.extent.volume * scale * scale * scale, 1e-9 * *b.extent.volume);
  EXPECT_NEAR(b.mean_curvature.max, a.mean_curvature.max / scale, 1e-9);
  EXPECT_NEAR(b.gaussian_curvature.mean, a.gaussian_curvature.mean / scale / scale, 1e-9);
  EXPECT_EQ(b.folded_edges, a.folded_edges);
  EXPECT_EQ(b.self_intersections, a.self_intersections);
}

TEST(Quality, ThreadsChangeNothing) {
  const test::Triangles t = test::shaken(test::sphere(5), .02);
  const Quality many = measure(t);
  const ThreadLimit one(1);
  const Quality single = measure(t);
  EXPECT_EQ(single.extent.area, many.extent.area);
  EXPECT_EQ(single.extent.volume, many.extent.volume);
  EXPECT_EQ(single.shape.mean, many.shape.mean);
  EXPECT_EQ(single.edge_length.std, many.edge_length.std);
  EXPECT_EQ(single.gaussian_curvature.mean, many.gaussian_curvature.mean);
  EXPECT_EQ(single.self_intersections, many.self_intersections);
  EXPECT_GT(*many.self_intersections, 0u);
}

TEST(Quality, OfAMeshWithoutFacesIsEmpty) {
  const Quality q = measure_quality(Mat3X::Zero(3, 4), make_adjacency(4, {}), {});
  EXPECT_EQ(q.min_angle.count, 0u);
  EXPECT_EQ(q.self_intersections, 0u);
  EXPECT_TRUE(q.worst_faces.empty());
  EXPECT_EQ(q.extent.area, 0);
}

TEST(Curvature, OfASphereIsOneOverTheRadius) {
  test::Triangles t = test::sphere(4);
  t.points *= 5;
  const Quality q = measure(t);
  EXPECT_NEAR(q.mean_curvature.mean, 1. / 5, 1e-3);
  EXPECT_NEAR(q.gaussian_curvature.mean, 1. / 25, 1e-3);
  EXPECT_NEAR(q.mean_curvature.min, q.mean_curvature.max, .02);
}

double angle_defect(const test::Triangles& t, const Adjacency& c, int v) {
  double defect = 2 * std::numbers::pi;
  for (int f : c.vertex_faces[v]) {
    const Triangle& s = c.faces[f];
    const size_t i = s[0] == v ? 0 : s[1] == v ? 1 : 2;
    const Vec3 u = t.points.col(s[(i + 1) % 3]) - t.points.col(v);
    const Vec3 w = t.points.col(s[(i + 2) % 3]) - t.points.col(v);
    defect -= std::acos(u.dot(w) / u.norm() / w.norm());
  }
  return defect;
}

/// Two hubs with many faces about a ring that goes up and down: their angles add up to several turns.
test::Triangles ruffle(int boundary_size) {
  test::Triangles t;
  t.points.resize(3, boundary_size + 2);
  for (int i = 0; i < boundary_size; ++i) {
    const double angle = 2 * std::numbers::pi * i / boundary_size;
    t.points.col(i) = Vec3(std::cos(angle), std::sin(angle), i % 2 == 0 ? 3 : -2.5);
    t.faces.push_back({i, (i + 1) % boundary_size, boundary_size});
    t.faces.push_back({(i + 1) % boundary_size, i, boundary_size + 1});
  }
  t.points.col(boundary_size) = Vec3(.1, 0, .5);
  t.points.col(boundary_size + 1) = Vec3(0, .1, -.5);
  return t;
}

TEST(Curvature, MixedAreasCoverTheSurfaceOnce) {
  for (const test::Triangles& t :
       {test::sphere(3, .35), ruffle(16), ruffle(5000)}) {  // with obtuse triangles too
    const Adjacency c = test::connect(t);
    const VertexCurvature k = measure_curvature(t.points, c);
    double area = 0, total = 0;
    for (int v = 0; v < c.vertex_count; ++v) {
      const double defect = angle_defect(t, c, v);
      total += defect;
      area += defect / k.gaussian[v];
    }
    EXPECT_NEAR(total, 4 * std::numbers::pi, 1e-9);  // Gauss and Bonnet
    EXPECT_NEAR(area / measure_extent(t.points, c).area, 1, 1e-10);
  }
}

TEST(Curvature, AnglesBeyondAFullTurnAreAllCounted) {
  const test::Triangles t = ruffle(16);
  const Adjacency c = test::connect(t);
  EXPECT_LT(angle_defect(t, c, 16), -4 * std::numbers::pi);
  EXPECT_LT(measure_curvature(t.points, c).gaussian[16], 0);
}

TEST(Curvature, IsNotDefinedOnTheBoundaryNorBesideFacesWithoutArea) {
  test::Triangles t = test::grid(4, test::flat);
  t.points.col(6) = t.points.col(1);
  const VertexCurvature k = measure_curvature(t.points, test::connect(t));
  EXPECT_TRUE(std::isnan(k.mean[0]));
  EXPECT_TRUE(std::isnan(k.mean[6]));
  EXPECT_NEAR(k.mean[18], 0, 1e-12);
  EXPECT_NEAR(k.gaussian[18], 0, 1e-12);
}

TEST(Quality, CountsTheFacesBelow20And30Degrees) {
  const test::Triangles t = test::grid(12, test::paraboloid, .45);
  const Quality q = measure_quality(t.points, test::connect(t), {});
  const auto below = [&](double degrees) {
    return static_cast<size_t>(std::ranges::count_if(
        t.faces, [&](const Triangle& face) { return min_angle(t.points, {face}) < degrees; }));
  };
  EXPECT_EQ(q.faces_below_20, below(20));
  EXPECT_EQ(q.faces_below_30, below(30));
  EXPECT_LT(q.faces_below_20, q.faces_below_30);
}

}  // namespace hooke::quality_test
