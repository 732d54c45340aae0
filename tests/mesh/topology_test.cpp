#include "hooke/mesh/topology.h"

#include <gtest/gtest.h>

#include <numeric>

#include "support/solids.h"

namespace hooke::topology_test {

TEST(Topology, OfACube) {
  const Topology t = measure_topology(test::connect(test::cube()));
  EXPECT_EQ(t.vertices, 8);
  EXPECT_EQ(t.edges, 18);
  EXPECT_EQ(t.faces, 12);
  EXPECT_EQ(t.euler, 2);
  EXPECT_EQ(t.components, 1);
  EXPECT_EQ(t.boundary_loops, 0);
  EXPECT_TRUE(t.closed());
}

TEST(Topology, OfAnAnnulusHasTwoLoops) {
  test::Triangles grid = test::grid(3, test::flat);
  std::erase_if(grid.faces, [](const Triangle& f) {  // the middle cell
    return std::min({f[0], f[1], f[2]}) == 5 && std::max({f[0], f[1], f[2]}) == 10;
  });
  ASSERT_EQ(grid.faces.size(), 16u);
  const Topology t = measure_topology(test::connect(grid));
  EXPECT_EQ(t.euler, 0);
  EXPECT_EQ(t.boundary_loops, 2);
  EXPECT_EQ(t.boundary_edges, 16);
  EXPECT_FALSE(t.closed());
}

TEST(Topology, IsolatedVerticesBelongToNoComponent) {
  test::Triangles two = test::both(test::cube(), test::equilateral());
  two.points.conservativeResize(3, two.points.cols() + 3);
  const Topology t = measure_topology(test::connect(two));
  EXPECT_EQ(t.components, 2);
  EXPECT_EQ(t.isolated_vertices, 3);
  EXPECT_EQ(t.boundary_loops, 1);
  EXPECT_EQ(t.euler, 3);
}

TEST(Topology, OfNothing) {
  const Topology t = measure_topology(make_adjacency(0, {}));
  EXPECT_EQ(t.components + t.boundary_loops + t.euler, 0);
  EXPECT_FALSE(t.closed());
}

TEST(Valence, OfASubdividedIcosahedronIsSixButForTwelveCorners) {
  const Valence v = count_valences(test::connect(test::sphere(2)));
  EXPECT_EQ(v.interior, (std::vector<int>{0, 0, 0, 0, 0, 12, 150}));
  EXPECT_TRUE(v.boundary.empty());
}

TEST(Valence, CountsEveryVertexWithAFaceOnce) {
  const Valence v = count_valences(test::connect(test::grid(4, test::flat)));
  EXPECT_EQ(std::accumulate(v.interior.begin(), v.interior.end(), 0), 9);
  EXPECT_EQ(v.boundary, (std::vector<int>{0, 0, 2, 2, 12}));
}

}  // namespace hooke::topology_test
