#include "hooke/mesh/memory_order.h"

#include <gtest/gtest.h>

#include <numeric>

#include "support/solids.h"

#include "hooke/mesh/adjacency.h"

namespace hooke::memory_order_test {

std::vector<int> numbers(size_t count) {
  std::vector<int> ids(count);
  std::iota(ids.begin(), ids.end(), 0);
  return ids;
}

std::vector<int> sorted(std::vector<int> ids) {
  std::ranges::sort(ids);
  return ids;
}

double mean_edge_span(const Adjacency& c) {
  double sum = 0;
  for (const auto& [a, b] : c.edges) sum += std::abs(a - b);
  return sum / static_cast<double>(c.edges.size());
}

TEST(Ordering, IsAPermutationOfAllVerticesAndFaces) {
  const Adjacency c = test::connect(test::two_parts_and_loose_vertices());
  const Permutation r = reorder(c.faces, bfs_cluster_order(c.vertex_count, c.faces));
  EXPECT_EQ(sorted(r.old_vertex), numbers(c.vertex_count));
  EXPECT_EQ(sorted(r.old_face), numbers(c.faces.size()));
}

TEST(Ordering, LeadsBackToTheFacesItCameFrom) {
  const Adjacency c = test::connect(test::shuffled(test::two_parts_and_loose_vertices()));
  const Permutation r = reorder(c.faces, bfs_cluster_order(c.vertex_count, c.faces));
  ASSERT_EQ(r.faces.size(), c.faces.size());
  for (size_t f = 0; f < r.faces.size(); ++f) {
    Triangle old;
    for (size_t k = 0; k < 3; ++k) old[k] = r.old_vertex[r.faces[f][k]];
    EXPECT_EQ(old, c.faces[r.old_face[f]]);
  }
}

TEST(Ordering, NewVerticesAreWhereTheOldOnesWent) {
  const Adjacency c = test::connect(test::two_parts_and_loose_vertices());
  const Permutation r = reorder(c.faces, bfs_cluster_order(c.vertex_count, c.faces));
  const std::vector<int> old = {7, 0, 100};
  const std::vector<int> fresh = r.new_vertices(old);
  ASSERT_EQ(fresh.size(), old.size());
  for (size_t i = 0; i < old.size(); ++i) EXPECT_EQ(r.old_vertex[fresh[i]], old[i]);
  EXPECT_TRUE(r.new_vertices({}).empty());
}

TEST(Ordering, FacesFollowTheirSmallestVertex) {
  const Adjacency c = test::connect(test::shuffled(test::sphere(3)));
  const Permutation r = reorder(c.faces, bfs_cluster_order(c.vertex_count, c.faces));
  EXPECT_TRUE(std::ranges::is_sorted(r.faces, {}, [](const Triangle& t) { return std::ranges::min(t); }));
}

TEST(Ordering, BringsNeighboursTogether) {
  const Adjacency c = test::connect(test::shuffled(test::grid(40, test::flat)));
  const Adjacency ordered =
      make_adjacency(c.vertex_count, reorder(c.faces, bfs_cluster_order(c.vertex_count, c.faces)).faces);
  EXPECT_LT(mean_edge_span(ordered), .2 * mean_edge_span(c));
}

TEST(Ordering, NothingComesOutOfNothing) {
  EXPECT_TRUE(bfs_cluster_order(0, {}).empty());
  EXPECT_TRUE(reorder({}, {}).faces.empty());
}

}  // namespace hooke::memory_order_test
