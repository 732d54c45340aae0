#include "hooke/mesh/wedges.h"

#include <gtest/gtest.h>

#include <random>

#include "hooke/constraints/crease_detection.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/halfedge_mesh.h"
#include "support/crease_solids.h"

namespace hooke {
namespace {

Connectivity parted(const test::Triangles& t) {
  Connectivity c = test::connect(t);
  std::vector<Edge> creases;
  for (int e : find_features(t.points, c, std::vector<double>(static_cast<size_t>(c.vertex_count), 1), {}))
    creases.push_back(c.edges[static_cast<size_t>(e)]);
  part_at_creases(c, creases);
  return c;
}

TEST(Creases, ACornerOfACubeHasThreeSidesAndAnEdgeTwo) {
  const Connectivity c = parted(test::irregular_cube(4));
  EXPECT_EQ(c.further_sides.size(), 8 * 2 + 12 * 3u);
  EXPECT_TRUE(std::ranges::is_sorted(c.further_sides));
  const Connectivity cut = cut_open(c);
  EXPECT_EQ(std::ranges::max(label_components(cut)), 5);
  const std::vector<int> chart = label_components(cut);
  for (size_t f = 0; f < cut.faces.size(); ++f)
    for (int v : cut.faces[f])
      EXPECT_EQ(chart[static_cast<size_t>(v)], chart[static_cast<size_t>(cut.faces[f][0])]);
}

TEST(Creases, SidesLieWhereTheirVerticesLie) {
  const test::Triangles t = test::step_block(3);
  const Connectivity c = parted(t);
  const Mat3X sides = side_points(t.points, c);
  for (size_t f = 0; f < c.faces.size(); ++f)
    for (size_t k = 0; k < 3; ++k) EXPECT_EQ(sides.col(c.side_faces[f][k]), t.points.col(c.faces[f][k]));
}

TEST(Creases, ACreaseWithALooseEndIsASlit) {
  test::Triangles t = test::grid(6, test::flat);
  Connectivity c = test::connect(t);
  part_at_creases(c, {{3, 10}, {10, 17}, {17, 24}});  // from the boundary to the middle
  EXPECT_EQ(c.further_sides, (std::vector<int>{3, 10, 17}));
  EXPECT_EQ(std::ranges::max(label_components(cut_open(c))), 0);
  EXPECT_EQ(crease_edges(c).size(), 3u);
}

TEST(Creases, WithoutCreasesSidesAreTheVertices) {
  Connectivity c = test::connect(test::cube());
  part_at_creases(c, {});
  EXPECT_EQ(&c.sides_of_faces(), &c.faces);
  EXPECT_EQ(c.side_count(), 8);
}

TEST(Creases, FlipsOfOtherEdgesKeepTheSides) {
  const Connectivity c = parted(test::irregular_cube(4));
  Triangulation t(c);
  std::mt19937 random(3);
  int flips = 0;
  for (int i = 0; i < 400; ++i) {
    const int h = static_cast<int>(random() % static_cast<unsigned>(t.half_edge_count()));
    if (t.is_constrained(h) || t.adjacent(t.apex(h), t.apex(t.twin(h)))) continue;
    t.flip(h);
    ++flips;
  }
  EXPECT_GT(flips, 50);
  Connectivity after = make_connectivity(c.vertex_count, t.faces());
  part_at_creases(after, crease_edges(c));
  EXPECT_EQ(after.side_faces, t.sides());
  EXPECT_EQ(after.further_sides, c.further_sides);
}

TEST(Creases, ASectorRunsFromCreaseToCrease) {
  const Triangulation t(parted(test::irregular_cube(4)));
  for (int h = 0; h < t.half_edge_count(); ++h) {
    const ShortList sector = t.sector(h);
    EXPECT_NE(std::ranges::find(sector, h), sector.end());
    for (int s : sector) {
      EXPECT_EQ(t.from(s), t.from(h));
      EXPECT_EQ(t.side(s), t.side(h));
    }
    EXPECT_EQ(t.is_constrained(sector.front()), t.on_crease(t.from(h)));
  }
}

}  // namespace
}  // namespace hooke
