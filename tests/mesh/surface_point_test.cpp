#include "hooke/mesh/surface_point.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "hooke/geometry/aabb_tree.h"
#include "hooke/io/vertex_lists.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/memory_order.h"
#include "support/meshes.h"
#include "support/solids.h"

namespace hooke::surface_point_test {

TEST(SurfacePoint, WalksToTheClosestPoint) {
  const test::Triangles t = test::grid(10, test::paraboloid, .3);
  const Adjacency c = make_adjacency(static_cast<int>(t.points.cols()), t.faces);
  const AabbTree tree(t.points, t.faces);
  for (int from : {0, 60, 120})
    for (const Vec3& x : {Vec3(.31, .72, .4), Vec3(.9, .15, .3), Vec3(.5, .5, 0)}) {
      const SurfacePoint found = locate(t.points, c, x, from);
      Vec3 y = Vec3::Zero();
      for (size_t k = 0; k < 3; ++k)
        y += found.weights[static_cast<Eigen::Index>(k)] * t.points.col(t.faces[found.face][k]);
      EXPECT_NEAR(found.weights.sum(), 1, 1e-12);
      EXPECT_NEAR((x - y).squaredNorm(), tree.closest(x).squared_distance, 1e-12);
    }
}

TEST(SurfacePoint, WalksAroundTheHubOfAFan) {
  constexpr int corners = 500;
  Mat3X points = Mat3X::Zero(3, corners + 1);
  std::vector<Triangle> faces;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * k / corners;
    points.col(k + 1) = Vec3(std::cos(angle), std::sin(angle), .2);
    faces.push_back({0, k + 1, (k + 1) % corners + 1});
  }
  const Adjacency c = make_adjacency(corners + 1, faces);
  const AabbTree tree(points, faces);
  for (const double radius : {0., .1, .5, .99})
    for (const double turn : {0., .3, 2.}) {  // edges of the rim, from that of the hint
      const double angle = 2 * std::numbers::pi * turn / corners;
      const Vec3 x(radius * std::cos(angle), radius * std::sin(angle), .2 * radius + .01);
      const SurfacePoint found = locate(points, c, x, 1);
      ASSERT_GE(found.face, 0);
      Vec3 y = Vec3::Zero();
      for (size_t k = 0; k < 3; ++k)
        y += found.weights[static_cast<Eigen::Index>(k)] * points.col(faces[found.face][k]);
      EXPECT_NEAR((x - y).squaredNorm(), tree.closest(x).squared_distance, 1e-9) << radius << ' ' << turn;
    }
}

/// The greatest distance, beyond that of the closest face, of what is found from the hub of a fan for points
/// close to its faces. The rim is given by the angle.
template <typename Rim>
double farthest_from_hub(int corners, const Rim& rim) {
  test::Triangles t{Mat3X::Zero(3, corners + 1), {}};
  for (int k = 0; k < corners; ++k) {
    t.points.col(k + 1) = rim(2 * std::numbers::pi * k / corners);
    t.faces.push_back({0, k + 1, (k + 1) % corners + 1});
  }
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0, 1);
  double farthest = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    test::Triangles fan = test::shuffled(t, seed);
    std::ranges::shuffle(fan.faces, random);
    const Permutation order = reorder(fan.faces, bfs_cluster_order(corners + 1, fan.faces));
    const Mat3X points = order.gather(fan.points);
    const Adjacency c = make_adjacency(corners + 1, order.faces);
    const AabbTree tree(points, c.faces);
    int hub = 0;
    for (int v = 0; v < c.vertex_count; ++v)
      if (std::ssize(c.vertex_faces[v]) == corners) hub = v;
    for (const Triangle& face : c.faces) {
      const double outwards = std::sqrt(share(random)), sideways = share(random);
      const Vec3 far_end = points.col(face[1]) + sideways * (points.col(face[2]) - points.col(face[1]));
      const Vec3 x = points.col(face[0]) + outwards * (far_end - points.col(face[0])) + Vec3(0, 0, .001);
      const double found = std::sqrt(closest_point_nearby(points, c, x, hub).squared_distance);
      farthest = std::max(farthest, found - std::sqrt(tree.closest(x).squared_distance));
    }
  }
  return farthest;
}

TEST(SurfacePoint, IsFoundFromTheHubOfAFan) {
  for (const int corners : {65, 100, 500}) {
    const auto flat = [](double angle) { return Vec3(2 * std::cos(angle), .15 * std::sin(angle), 0); };
    const auto off_centre = [&](double angle) { return Vec3(flat(angle) + Vec3(1.8, 0, 0)); };
    const auto cone = [](double angle) { return Vec3(.2 * std::cos(angle), .2 * std::sin(angle), 1); };
    EXPECT_NEAR(farthest_from_hub(corners, flat), 0, 1e-9) << corners;
    EXPECT_NEAR(farthest_from_hub(corners, off_centre), 0, 1e-9) << corners;
    EXPECT_NEAR(farthest_from_hub(corners, cone), 0, 1e-9) << corners;
  }
}

TEST(SurfacePoint, IsFoundFromTheHubOfAPleatedFan) {
  constexpr int corners = 2000;
  test::Triangles t{Mat3X::Zero(3, corners + 1), {}};
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * k / corners;
    t.points.col(k + 1) = Vec3(std::cos(angle), std::sin(angle), k % 2 == 0 ? .01 : -.01);
    t.faces.push_back({0, k + 1, (k + 1) % corners + 1});
  }
  for (const test::Triangles& fan : {t, test::shuffled(t)}) {
    const Adjacency c = test::connect(fan);
    const AabbTree tree(fan.points, fan.faces);
    int hub = 0;
    for (int v = 0; v < c.vertex_count; ++v)
      if (c.vertex_faces[v].size() == corners) hub = v;
    for (int k = 0; k < 200; ++k) {
      const double angle = .1 * k, radius = .2 + .003 * k;
      const Vec3 x(radius * std::cos(angle), radius * std::sin(angle), .002 * (k % 5));
      const ClosestPoint found = closest_point_nearby(fan.points, c, x, hub);
      EXPECT_NEAR(std::sqrt(found.squared_distance), std::sqrt(tree.closest(x).squared_distance), 1e-3) << k;
    }
  }
}

TEST(SurfacePoint, AVertexWithoutFacesLiesOnNone) {
  const Mat3X points{{0, 1, 0, 5}, {0, 0, 1, 5}, {0, 0, 0, 5}};
  EXPECT_EQ(locate(points, make_adjacency(4, {{0, 1, 2}}), points.col(3), 3).face, -1);
}

TEST(MapText, HasALinePerVertex) {
  const std::vector<MapEntry> map = {{7, {3, Vec3(.25, .75, 0)}}, {-1, {0, Vec3(0, .1, .9)}}, {2, {}}};
  EXPECT_EQ(map_text(map), "7 3 0.25 0.75 0\n-1 0 0 0.1 0.9\n2 -1 0 0 0\n");
}

}  // namespace hooke::surface_point_test
