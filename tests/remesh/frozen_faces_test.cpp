// Frozen vertices: whatever changes around them, the faces between them are those of the input.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "hooke/mesh/memory_order.h"
#include "hooke/remesh/remesh.h"
#include "support/crease_solids.h"
#include "support/junction_sheets.h"
#include "support/remeshed.h"
#include "support/solids.h"

namespace hooke::frozen_faces_test {

using Place = std::array<double, 3>;

std::vector<int> within(const Mat3X& points, const Vec3& centre, double radius) {
  std::vector<int> ids;
  for (int v = 0; v < points.cols(); ++v)
    if ((points.col(v) - centre).norm() < radius) ids.push_back(v);
  return ids;
}

/// The faces whose corners are all at one of the places, by these, from the least on; one entry per face.
std::multiset<std::array<Place, 3>> faces_between(const Mat3X& points, const std::vector<Triangle>& faces,
                                                  const std::set<Place>& places) {
  std::multiset<std::array<Place, 3>> found;
  for (const Triangle& t : faces) {
    std::array<Place, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = {points(0, t[k]), points(1, t[k]), points(2, t[k])};
    if (!std::ranges::all_of(corners, [&](const Place& x) { return places.contains(x); })) continue;
    std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
    found.insert(corners);
  }
  return found;
}

/// Remeshes with the vertices in the ball frozen, and expects the faces there to be in the result.
void expect_frozen(const test::Triangles& t, const TriMesh& input, const Vec3& centre, double radius,
                   RemeshOptions options) {
  options.constraints.frozen_vertices = within(t.points, centre, radius);
  std::set<Place> places;
  for (int v : options.constraints.frozen_vertices)
    places.insert({t.points(0, v), t.points(1, v), t.points(2, v)});
  TriMesh mesh = input;
  const RemeshResult result = remesh(mesh, find_memory_order(mesh), options);
  const auto before = faces_between(t.points, t.faces, places),
             after = faces_between(vertex_points(mesh), triangles_of(mesh), places);
  ASSERT_GE(before.size(), 4u);
  EXPECT_TRUE(std::ranges::includes(after, before)) << before.size() << ' ' << after.size();
  const Mat3X points = vertex_points(mesh), input_points = vertex_points(input);
  EXPECT_TRUE(points.cols() != input_points.cols() || points != input_points);
}

RemeshOptions options_for(ConnectivityMode mode, Effort effort = Effort::fast) {
  RemeshOptions options;
  options.connectivity = mode;
  options.effort = effort;
  return options;
}

class Frozen : public testing::TestWithParam<ConnectivityMode> {};

TEST_P(Frozen, StayOnASmoothSurfaceAtAnyLength) {
  const test::Triangles t = test::sphere(3, .35, 3);
  for (const double length : {.5, 1., 3.})
    for (const Effort effort : {Effort::fast, Effort::standard})
      expect_frozen(t, test::with_length(t, length * test::natural(t)), {0, .6, .8}, .5,
                    options_for(GetParam(), effort));
}

TEST_P(Frozen, StayAtCreasesAndCorners) {
  const test::Triangles t = test::irregular_cube(6);
  const Vec3 corner = t.points.rowwise().maxCoeff();
  const double side = (corner - t.points.rowwise().minCoeff()).maxCoeff();
  for (const double length : {.5, 1., 3.})
    for (const Vec3& centre : {corner, Vec3(corner - side * Vec3(.5, 0, 0))})
      expect_frozen(t, test::with_length(t, length * test::natural(t)), centre, .4 * side,
                    options_for(GetParam()));
}

TEST_P(Frozen, StayAtTheBoundary) {
  const test::Triangles t = test::grid(
      10, [](double x, double y) { return .1 * x * y; }, .3, 5);
  for (const double length : {.5, 1., 3.})
    expect_frozen(t, test::with_length(t, length * test::natural(t)), {.5, 0, 0}, .3,
                  options_for(GetParam()));
}

TEST_P(Frozen, StayInAllSheetsOfAJunction) {
  const test::Triangles t = test::shaken(test::fan(test::on_axis({0, .9, 2.1, 3, 4.2, 5}), 3, 4, 4), .3);
  for (const double length : {.6, 1., 2.}) {
    const TriMesh sheets = test::sheets(t, length);
    test::Triangles apart;
    apart.points = vertex_points(sheets);
    apart.faces = triangles_of(sheets);
    expect_frozen(apart, sheets, {2.1, 0, 0}, 1.6, options_for(GetParam()));
  }
}

INSTANTIATE_TEST_SUITE_P(Modes, Frozen, testing::Values(ConnectivityMode::flip, ConnectivityMode::adapt),
                         [](const auto& mode) {
                           return mode.param == ConnectivityMode::flip ? "flip" : "adapt";
                         });

}  // namespace hooke::frozen_faces_test
