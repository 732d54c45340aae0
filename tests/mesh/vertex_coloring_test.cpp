#include "hooke/mesh/vertex_coloring.h"

#include <gtest/gtest.h>

#include <mutex>
#include <numeric>
#include <set>

#include "support/solids.h"

#include "hooke/mesh/adjacency.h"

namespace hooke::vertex_coloring_test {

std::vector<Adjacency> meshes() {
  const auto connect = [](const test::Triangles& t) { return test::connect(t); };
  test::Triangles bow_tie =
      test::triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}});
  bow_tie.points.conservativeResize(3, 6);  // and a vertex without faces
  return {connect(test::sphere(3)), connect(test::grid(20, test::flat)), connect(test::cube()),
          connect(bow_tie)};
}

TEST(VertexColoring, RingEntriesNameEveryEdgeAndFaceOfAVertexOnce) {
  for (const Adjacency& c : meshes()) {
    const VertexColoring plan = color_vertices(c);
    for (int v = 0; v < c.vertex_count; ++v) {
      std::multiset<int> edges, faces;
      for (const RingEntry& s : plan.rings[v]) {
        edges.insert(s.edge);
        if (s.face >= 0) faces.insert(s.face);
      }
      EXPECT_EQ(edges, std::multiset<int>(c.vertex_edges[v].begin(), c.vertex_edges[v].end()));
      EXPECT_EQ(faces, std::multiset<int>(c.vertex_faces[v].begin(), c.vertex_faces[v].end()));
    }
  }
}

TEST(VertexColoring, AFaceLiesBetweenItsRingEntryAndTheNext) {
  for (const Adjacency& c : meshes()) {
    const VertexColoring plan = color_vertices(c);
    for (int v = 0; v < c.vertex_count; ++v) {
      const auto ring = plan.rings[v];
      for (size_t i = 0; i < ring.size(); ++i) {
        const Edge& e = c.edges[ring[i].edge];
        EXPECT_EQ(e[0] + e[1], v + ring[i].neighbour);
        if (ring[i].face < 0) continue;
        Triangle t = c.faces[ring[i].face];
        std::rotate(t.begin(), std::ranges::find(t, v), t.end());
        EXPECT_EQ(t, (Triangle{v, ring[i].neighbour, ring[(i + 1) % ring.size()].neighbour}));
        int across = -1;
        for (size_t f = 0; f < c.faces.size(); ++f)
          for (size_t k = 0; k < 3; ++k)
            if (c.faces[f][k] == t[2] && c.faces[f][(k + 1) % 3] == t[1]) across = c.faces[f][(k + 2) % 3];
        EXPECT_EQ(ring[i].across, across);
      }
    }
  }
}

TEST(VertexColoring, EveryVertexIsSweptOnceAndLooksAtNoOtherBlockOfItsWave) {
  for (const Adjacency& c : meshes()) {
    const VertexColoring plan = color_vertices(c);
    std::vector<int> swept(c.vertex_count, 0);
    std::mutex mutex;
    for_each_block(plan, [&](int begin, int end) {
      const std::lock_guard lock(mutex);
      for (int v = begin; v < end; ++v) ++swept[v];
    });
    for (int times : swept) EXPECT_EQ(times, 1);
    for (const std::vector<int>& color : plan.colors) {
      const std::set<int> blocks(color.begin(), color.end());
      for (int v = 0; v < c.vertex_count; ++v) {
        if (!blocks.contains(v / plan.block)) continue;
        for (const RingEntry& s : plan.rings[v])
          for (int w : {s.neighbour, s.across}) {
            const bool elsewhere = w >= 0 && w / plan.block != v / plan.block;
            EXPECT_FALSE(elsewhere && blocks.contains(w / plan.block));
          }
      }
    }
  }
}

TEST(VertexColoring, OneBlockSweepsAllVerticesInOrderOverTheSameRings) {
  for (const Adjacency& c : meshes()) {
    const VertexColoring one = color_as_one_block(c), many = color_vertices(c);
    std::vector<int> swept, all(c.vertex_count);
    std::iota(all.begin(), all.end(), 0);
    for_each_block(one, [&](int begin, int end) {
      for (int v = begin; v < end; ++v) swept.push_back(v);
    });
    EXPECT_EQ(swept, all);
    for (int v = 0; v < c.vertex_count; ++v)
      EXPECT_TRUE(std::ranges::equal(one.rings[v], many.rings[v], {}, &RingEntry::edge, &RingEntry::edge));
  }
}

}  // namespace hooke::vertex_coloring_test
