#include "hooke/connectivity/edge_splits.h"

#include <gtest/gtest.h>

#include "support/working_scene.h"

#include "hooke/constraints/constraints.h"
#include "hooke/constraints/feature_curves.h"
#include "hooke/mesh/extent.h"
#include "hooke/working_mesh/working_mesh.h"

namespace hooke::edge_splits_test {

constexpr int cells = 6;

int quadrupled(test::WorkingScene& s) {
  const int splits = subdivide(s.mesh);
  compact(s.mesh);
  return splits;
}

TEST(Subdivision, EveryFaceBecomesFour) {
  test::WorkingScene s(test::sphere(2, .2, 3), test::unit_sphere());
  const size_t faces = s.adjacency.faces.size();
  EXPECT_EQ(quadrupled(s), static_cast<int>(s.adjacency.edges.size()));
  EXPECT_EQ(s.halfedges.faces().size(), 4 * faces);
}

TEST(Subdivision, NewVerticesAreRegularAndOldOnesKeepTheirEdges) {
  test::WorkingScene s(test::grid(cells, test::flat, .2), test::plane());
  for (size_t v = 0; v < s.vertices.origins.size(); ++v) s.vertices.origins[v] = static_cast<int>(v);
  for (int corner : {0, cells, cells * (cells + 1), (cells + 1) * (cells + 1) - 1})
    s.vertices.corner_valences[corner] = s.halfedges.valence(corner);
  std::vector<int> valences;
  for (int v = 0; v < s.adjacency.vertex_count; ++v) valences.push_back(s.halfedges.valence(v));
  quadrupled(s);
  int fresh = 0;
  for (size_t i = 0; i < s.vertices.origins.size(); ++i) {
    const int v = static_cast<int>(i), origin = s.vertices.origins[i];
    if (origin >= 0) {
      EXPECT_EQ(s.halfedges.valence(v), valences[origin]);
    } else {
      EXPECT_EQ(s.halfedges.valence(v), s.halfedges.on_boundary(v) ? 4 : 6);
      ++fresh;
    }
  }
  EXPECT_EQ(fresh, static_cast<int>(s.adjacency.edges.size()));
}

TEST(Subdivision, FacesHaveTheirOldSize) {
  const test::Triangles t = test::grid(cells, test::flat, .2);
  test::WorkingScene s(t, test::plane());
  const double area = total_area(t.points, t.faces);
  std::vector<double> quarters;
  for (const Triangle& f : t.faces) quarters.push_back(total_area(t.points, {f}) / 4);
  quadrupled(s);
  EXPECT_NEAR(total_area(s.positions.points, s.halfedges.faces()), area, 1e-12);
  for (const Triangle& f : s.halfedges.faces()) {
    const double own = total_area(s.positions.points, {f});
    EXPECT_TRUE(std::ranges::any_of(quarters, [&](double q) { return std::abs(own - q) < 1e-12; })) << own;
  }
}

TEST(Subdivision, NewVerticesLieOnTheSurface) {
  test::WorkingScene s(test::sphere(2, .2, 3), test::unit_sphere());
  quadrupled(s);
  for (const auto& x : s.positions.points.colwise()) EXPECT_NEAR(x.norm(), 1, 1e-9);
}

TEST(Subdivision, CurvesAndCreasesAreSplit) {
  std::vector<Edge> crease;
  for (int v = cells / 2 * (cells + 1); crease.size() < cells; ++v) crease.push_back({v, v + 1});
  test::WorkingScene s(test::grid(cells, test::flat), test::plane(), crease);
  const std::vector<int> before = s.mesh.curve_edges.present;
  quadrupled(s);
  for (size_t c = 0; c < before.size(); ++c) EXPECT_EQ(s.mesh.curve_edges.present[c], 2 * before[c]);
  EXPECT_EQ(s.constraints.creases.size(), 2 * crease.size());
  for (const auto& [a, b] : s.constraints.creases) {
    EXPECT_NEAR(s.positions.points(1, a), .5, 1e-12);
    EXPECT_NEAR(s.positions.points(1, b), .5, 1e-12);
  }
}

TEST(Subdivision, ABoundaryThatStandsStillStaysWhole) {
  const test::Triangles t = test::grid(cells, test::flat, .2);
  test::WorkingScene s(t, test::plane());
  for (size_t v = 0; v < s.constraints.freedom.size(); ++v)
    if (s.halfedges.on_boundary(static_cast<int>(v))) {
      s.constraints.freedom[v] = Freedom::fixed;
      s.constraints.curve[v] = -1;
    }
  s.constraints.curves.clear();
  WorkingMesh still(s.adjacency, s.vertices, s.retraction);
  const int boundary = 4 * cells;
  EXPECT_EQ(subdivide(still), static_cast<int>(s.adjacency.edges.size()) - boundary);
  compact(still);
  EXPECT_NEAR(total_area(s.positions.points, still.halfedges.faces()), total_area(t.points, t.faces), 1e-12);
}

}  // namespace hooke::edge_splits_test
