#include "hooke/mesh/touching_solids.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/extent.h"
#include "hooke/mesh/repair.h"
#include "support/solids.h"

namespace hooke::touching_solids_test {

test::Triangles shifted(test::Triangles t, const Vec3& by) {
  t.points.colwise() += by;
  return t;
}

test::Triangles inside_out(test::Triangles t) {
  for (Triangle& f : t.faces) std::swap(f[1], f[2]);
  return t;
}

/// Two cubes side by side with the vertices of their wall in common, and its faces twice.
test::Triangles with_wall() {
  test::Triangles mirrored = test::cube();
  mirrored.points.row(0) = -mirrored.points.row(0);
  test::Triangles t = test::both(test::cube(), inside_out(mirrored));
  for (Triangle& f : t.faces)
    for (int& v : f)
      for (int first = 0; first < 8; ++first)
        if (t.points.col(v) == t.points.col(first)) v = std::min(v, first);
  return t;
}

/// The sorted volumes of the closed bodies of a repaired mesh; of its open parts 0.
std::multiset<double> volumes(const test::Triangles& t) {
  const Repaired r = repair(t.points, t.faces, {.repair = true}, {});
  const std::vector<int> bodies = closed_bodies(r.triangles);
  std::multiset<double> found;
  for (const int body : std::set<int>(bodies.begin(), bodies.end())) {
    std::vector<Triangle> faces;
    for (size_t f = 0; f < bodies.size(); ++f)
      if (bodies[f] == body) faces.push_back(r.triangles[f]);
    const auto vertices = static_cast<int>(r.points.cols());
    found.insert(body < 0 ? 0
                          : std::round(*measure_extent(r.points, make_adjacency(vertices, faces)).volume));
  }
  return found;
}

TEST(TouchingSolids, EachGetsTheWallThatTheyShare) {
  const test::Triangles t = with_wall();
  const std::optional<Sheets> sheets = separate_touching_solids(t.points, t.faces);
  ASSERT_TRUE(sheets);
  EXPECT_EQ(std::ssize(sheets->source), t.points.cols() + 4);
  EXPECT_EQ(sheets->triangles.size(), t.faces.size());
  EXPECT_EQ(volumes(t), (std::multiset<double>{1, 1}));
}

TEST(TouchingSolids, AreTakenApartWhateverElseIsThere) {
  const test::Triangles solids = with_wall(), away = shifted(test::cube(), {5, 0, 0});
  test::Triangles turned = away, open = away;
  std::swap(turned.faces[0][1], turned.faces[0][2]);
  open.faces.pop_back();
  EXPECT_EQ(volumes(test::both(solids, open)), (std::multiset<double>{0, 1, 1}));
  EXPECT_EQ(volumes(test::both(solids, turned)), (std::multiset<double>{1, 1, 1}));
  test::Triangles large = inside_out(away);
  large.points *= 2;
  EXPECT_EQ(volumes(test::both(solids, large)), (std::multiset<double>{1, 1, 8}));
  test::Triangles twice = solids;
  const auto [a, b, c] = solids.faces[0];
  twice.faces.push_back({b, c, a});
  EXPECT_EQ(volumes(twice), (std::multiset<double>{1, 1}));
  EXPECT_EQ(volumes(test::both(solids, shifted(away, {1e6, 0, 0}))), (std::multiset<double>{1, 1, 1}))
      << "far away, so that walls are no thicker than a rounding of the whole";
}

TEST(TouchingSolids, AreNoneWhereFacesAreNotThoseOfSolids) {
  EXPECT_FALSE(separate_touching_solids(test::cube().points, test::cube().faces));
  test::Triangles open = with_wall();
  open.faces.erase(open.faces.begin());
  EXPECT_FALSE(separate_touching_solids(open.points, open.faces));
  const test::Triangles turned = inside_out(with_wall());
  EXPECT_FALSE(separate_touching_solids(turned.points, turned.faces));
}

TEST(ClosedBodies, HangTogetherOverEdgesOfTwoFaces) {
  test::Triangles t = test::both(test::cube(), shifted(test::cube(), {1, 1, 1}));
  for (Triangle& f : t.faces)
    for (int& v : f)
      for (int first = 0; first < 8; ++first)
        if (t.points.col(v) == t.points.col(first)) v = std::min(v, first);  // one vertex in common
  t.faces.push_back({0, 0, 1});
  const std::vector<int> bodies = closed_bodies(t.faces);
  EXPECT_EQ(std::set<int>(bodies.begin(), bodies.end()).size(), 3u);
  EXPECT_EQ(bodies.back(), -1);
  EXPECT_EQ(std::ranges::count(bodies, -1), 1);
  t.faces.erase(t.faces.begin());
  const std::vector<int> opened = closed_bodies(t.faces);
  EXPECT_EQ(std::ranges::count(opened, -1), 12);
}

}  // namespace hooke::touching_solids_test
