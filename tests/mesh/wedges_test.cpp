#include "hooke/mesh/wedges.h"

#include <gtest/gtest.h>

#include <random>

#include "hooke/constraints/crease_detection.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/halfedge_mesh.h"
#include "support/crease_solids.h"

namespace hooke::wedges_test {

Adjacency parted(const test::Triangles& t) {
  Adjacency c = test::connect(t);
  std::vector<Edge> creases;
  for (int e : detect_creases(t.points, c, std::vector<double>(c.vertex_count, 1), {}))
    creases.push_back(c.edges[e]);
  split_wedges(c, creases);
  return c;
}

TEST(Creases, ACornerOfACubeHasThreeWedgesAndAnEdgeTwo) {
  const Adjacency c = parted(test::irregular_cube(4));
  EXPECT_EQ(c.extra_wedges.size(), 8 * 2 + 12 * 3u);
  EXPECT_TRUE(std::ranges::is_sorted(c.extra_wedges));
  const Adjacency cut = cut_open(c);
  EXPECT_EQ(std::ranges::max(label_components(cut)), 5);
  const std::vector<int> chart = label_components(cut);
  for (size_t f = 0; f < cut.faces.size(); ++f)
    for (int v : cut.faces[f]) EXPECT_EQ(chart[v], chart[cut.faces[f][0]]);
}

TEST(Creases, WedgesLieWhereTheirVerticesLie) {
  const test::Triangles t = test::step_block(3);
  const Adjacency c = parted(t);
  const Mat3X wedges = wedge_points(t.points, c);
  for (size_t f = 0; f < c.faces.size(); ++f)
    for (size_t k = 0; k < 3; ++k) EXPECT_EQ(wedges.col(c.wedge_faces[f][k]), t.points.col(c.faces[f][k]));
}

TEST(Creases, ACreaseWithALooseEndIsASlit) {
  test::Triangles t = test::grid(6, test::flat);
  Adjacency c = test::connect(t);
  split_wedges(c, {{3, 10}, {10, 17}, {17, 24}});  // from the boundary to the middle
  EXPECT_EQ(c.extra_wedges, (std::vector<int>{3, 10, 17}));
  EXPECT_EQ(std::ranges::max(label_components(cut_open(c))), 0);
  EXPECT_EQ(crease_edges(c).size(), 3u);
}

TEST(Creases, WithoutCreasesWedgesAreTheVertices) {
  Adjacency c = test::connect(test::cube());
  split_wedges(c, {});
  EXPECT_EQ(&c.wedges_of_faces(), &c.faces);
  EXPECT_EQ(c.wedge_count(), 8);
}

TEST(Creases, FlipsOfOtherEdgesKeepTheWedges) {
  const Adjacency c = parted(test::irregular_cube(4));
  HalfedgeMesh t(c);
  std::mt19937 random(3);
  int flips = 0;
  for (int i = 0; i < 400; ++i) {
    const int h = static_cast<int>(random() % static_cast<unsigned>(t.half_edge_count()));
    if (t.is_crease(h) || t.adjacent(t.opposite_vertex(h), t.opposite_vertex(t.twin(h)))) continue;
    t.flip(h);
    ++flips;
  }
  EXPECT_GT(flips, 50);
  Adjacency after = make_adjacency(c.vertex_count, t.faces());
  split_wedges(after, crease_edges(c));
  EXPECT_EQ(after.wedge_faces, t.wedges());
  EXPECT_EQ(after.extra_wedges, c.extra_wedges);
}

TEST(Creases, ASectorRunsFromCreaseToCrease) {
  const HalfedgeMesh t(parted(test::irregular_cube(4)));
  for (int h = 0; h < t.half_edge_count(); ++h) {
    const SmallIntList sector = t.wedge_halfedges(h);
    EXPECT_NE(std::ranges::find(sector, h), sector.end());
    for (int s : sector) {
      EXPECT_EQ(t.from(s), t.from(h));
      EXPECT_EQ(t.wedge(s), t.wedge(h));
    }
    EXPECT_EQ(t.is_crease(sector.front()), t.on_crease(t.from(h)));
  }
}

}  // namespace hooke::wedges_test
