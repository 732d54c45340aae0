#include "hooke/filter/surface_field.h"

#include <gtest/gtest.h>

#include "hooke/geometry/triangle.h"
#include "hooke/mesh/normals.h"
#include "solids.h"

namespace hooke {
namespace {

/// A cone of so many faces about vertex 0, and a strip around it.
test::Triangles hub(int spokes) {
  test::Triangles t{Mat3X(3, 1 + 2 * spokes), {}};
  t.points.col(0) = Vec3(0, 0, .3);
  for (int k = 0; k < spokes; ++k) {
    const double angle = 2 * std::numbers::pi * k / spokes;
    const Vec3 out(std::cos(angle), std::sin(angle), 0);
    t.points.col(1 + k) = out;
    t.points.col(1 + spokes + k) = 1.2 * out - .2 * Vec3::UnitZ();
    const int next = (k + 1) % spokes;
    t.faces.push_back({0, 1 + k, 1 + next});
    t.faces.push_back({1 + k, 1 + spokes + k, 1 + spokes + next});
    t.faces.push_back({1 + k, 1 + spokes + next, 1 + next});
  }
  return t;
}

double squared_distance_to_all(const test::Triangles& t, const Vec3& x) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : t.faces)
    least = std::min(
        least,
        closest_point_on_triangle(t.points.col(a), t.points.col(b), t.points.col(c), x).squared_distance);
  return least;
}

TEST(NearFaces, NoFaceAboutTheAnchorIsCloser) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> coordinate(-1.5, 1.5);
  for (const test::Triangles& t : {hub(60), hub(5), test::shaken(test::grid(2, test::flat), .2)}) {
    const Connectivity c = test::connect(t);
    const Mat3X normals = vertex_normals(t.points, c);
    const NearFaces faces{t.points, normals, c};
    for (int round = 0; round < 300; ++round) {
      const Vec3 x(coordinate(random), coordinate(random), coordinate(random));
      // All faces of a cone are about its tip or a neighbour of it; so are those of a grid of two by two.
      const int anchor = t.faces.size() == 8 ? 4 : 0;
      const Foot foot = faces.closest_point(x, anchor);
      EXPECT_EQ(foot.status, FootStatus::converged);
      EXPECT_NEAR((foot.point - x).squaredNorm(), squared_distance_to_all(t, x), 1e-12);
      EXPECT_NEAR(foot.normal.norm(), 1, 1e-12);
    }
  }
}

TEST(NearFaces, AFaceWithinADistanceIsNoFartherThanTheClosestOne) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(-1.5, 1.5);
  const test::Triangles t = test::shaken(test::grid(4, test::flat), .1);
  const Connectivity c = test::connect(t);
  const Mat3X normals = vertex_normals(t.points, c);
  const NearFaces faces{t.points, normals, c};
  int within = 0;
  for (int round = 0; round < 300; ++round) {
    const Vec3 x(coordinate(random), coordinate(random), .1 * coordinate(random));
    const Foot foot = faces.closest_point(x, 12);
    const double distance = (foot.point - x).norm();
    EXPECT_FALSE(faces.has_face_within(x, 12, .999 * distance));
    within += faces.has_face_within(x, foot.anchor, 1.001 * distance);  // the foot is on one of its faces
  }
  EXPECT_EQ(within, 300);
}

TEST(NearFaces, AnAnchorWithoutFacesHasNoFoot) {
  test::Triangles t = test::equilateral();
  t.points.conservativeResize(3, 4);
  t.points.col(3) = Vec3(5, 5, 5);
  const Connectivity c = test::connect(t);
  const Mat3X normals = vertex_normals(t.points, c);
  const Foot foot = NearFaces{t.points, normals, c}.closest_point(Vec3(1, 2, 3), 3);
  EXPECT_EQ(foot.status, FootStatus::no_cover);
  EXPECT_EQ(foot.point, Vec3(1, 2, 3));
}

}  // namespace
}  // namespace hooke
