#include "hooke/mesh/halfedge_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/topology.h"
#include "hooke/mesh/wedges.h"
#include "support/crease_solids.h"
#include "support/working_scene.h"

namespace hooke::halfedge_mesh_test {

HalfedgeMesh triangulate(const test::Triangles& t, const std::vector<Edge>& creases = {}) {
  Adjacency c = make_adjacency(static_cast<int>(t.points.cols()), t.faces);
  split_wedges(c, creases);
  return HalfedgeMesh(c);
}

std::multiset<std::set<int>> corner_sets(const HalfedgeMesh& t) {
  std::multiset<std::set<int>> sets;
  for (const Triangle& f : t.faces()) sets.insert(std::set<int>(f.begin(), f.end()));
  return sets;
}

void expect_sound(const HalfedgeMesh& t, int vertices) {
  for (int h = 0; h < t.half_edge_count(); ++h) {
    const int twin = t.twin(h);
    if (twin < 0) continue;
    EXPECT_EQ(t.twin(twin), h);
    EXPECT_EQ(t.from(twin), t.to(h));
    EXPECT_EQ(t.to(twin), t.from(h));
  }
  const Adjacency c = make_adjacency(vertices, t.faces());
  for (int v = 0; v < vertices; ++v) {
    EXPECT_EQ(t.valence(v), static_cast<int>(c.vertex_edges[v].size()));
    std::set<int> faces;
    for (int h : t.outgoing(v)) {
      EXPECT_EQ(t.from(h), v);
      faces.insert(h / 3);
    }
    EXPECT_EQ(faces, std::set<int>(c.vertex_faces[v].begin(), c.vertex_faces[v].end()));
    for (int w : c.vertex_neighbours[v]) EXPECT_TRUE(t.adjacent(v, w));
  }
}

TEST(HalfedgeMesh, StaysSoundUnderAnyFlips) {
  const test::Triangles grid = test::grid(6, test::flat);
  const int n = static_cast<int>(grid.points.cols());
  HalfedgeMesh t = triangulate(grid);
  std::mt19937 random(3);
  int flips = 0;
  for (int i = 0; i < 500; ++i) {
    const int h = static_cast<int>(random() % static_cast<unsigned>(t.half_edge_count()));
    if (t.twin(h) < 0 || t.adjacent(t.opposite_vertex(h), t.opposite_vertex(t.twin(h)))) continue;
    t.flip(h);
    ++flips;
  }
  EXPECT_GT(flips, 100);
  expect_sound(t, n);
  EXPECT_EQ(test::boundary_edges(n, t.faces()), test::boundary_edges(n, grid.faces));
  EXPECT_NO_THROW(build_mesh(grid.points, t.faces()));
}

TEST(HalfedgeMesh, TwoFlipsOfAnEdgeGiveTheSameFaces) {
  const test::Triangles ball = test::sphere(1);
  HalfedgeMesh t = triangulate(ball);
  const auto before = corner_sets(t);
  t.flip(10);
  EXPECT_NE(corner_sets(t), before);
  t.flip(HalfedgeMesh::flipped(10));
  EXPECT_EQ(corner_sets(t), before);
}

TEST(HalfedgeMesh, FlipsAroundKeepConstrainedEdges) {
  const test::Triangles grid = test::grid(6, test::flat);
  std::mt19937 random(5);
  std::vector<Edge> creases;
  for (int i = 0; i < 20; ++i) {
    const Triangle& face = grid.faces[random() % grid.faces.size()];
    creases.push_back({face[0], face[1]});
  }
  HalfedgeMesh t = triangulate(grid, creases);
  const auto any = [&] { return static_cast<int>(random() % static_cast<unsigned>(t.half_edge_count())); };
  const auto constrained = [&] {
    std::multiset<std::set<int>> edges;
    for (int h = 0; h < t.half_edge_count(); ++h)
      if (t.is_crease(h)) edges.insert({t.from(h), t.to(h)});
    return edges;
  };
  const auto before = constrained();
  EXPECT_GE(before.size(), 20u);
  for (int i = 0; i < 500; ++i) {
    const int h = any();
    if (t.twin(h) < 0 || t.is_crease(h) || t.adjacent(t.opposite_vertex(h), t.opposite_vertex(t.twin(h))))
      continue;
    t.flip(h);
    for (int outer : {HalfedgeMesh::flipped(h), t.twin(HalfedgeMesh::flipped(h))})
      EXPECT_FALSE(t.is_crease(outer));
  }
  EXPECT_EQ(constrained(), before);
}

/// Splits and collapses at random, then closes the gaps.
HalfedgeMesh shaken(HalfedgeMesh t, int steps, unsigned seed) {
  std::mt19937 random(seed);
  for (int i = 0; i < steps; ++i) {
    const int h = static_cast<int>(random() % static_cast<unsigned>(t.half_edge_count()));
    if (t.is_removed(h / 3)) continue;
    if (random() % 3 == 0)
      t.split(h);
    else if (t.may_collapse(h))
      t.collapse(h, t.to(h));
  }
  t.compact();
  return t;
}

TEST(HalfedgeMesh, SplitsAndCollapsesKeepTheTopology) {
  for (const test::Triangles& start : {test::grid(6, test::flat), test::sphere(2)}) {
    const Topology before =
        measure_topology(make_adjacency(static_cast<int>(start.points.cols()), start.faces));
    for (unsigned seed = 1; seed <= 4; ++seed) {
      const HalfedgeMesh t = shaken(triangulate(start), 3000, seed);
      expect_sound(t, t.id_count());
      const Topology after = measure_topology(make_adjacency(t.id_count(), t.faces()));
      EXPECT_EQ(after.euler, before.euler);
      EXPECT_EQ(after.boundary_loops, before.boundary_loops);
      EXPECT_EQ(after.components, before.components);
      EXPECT_EQ(after.isolated_vertices, 0);
    }
  }
}

/// Whether removing the vertex `end` of h breaks no crease: it lies on none, or slides along that of h.
bool is_free_to_go(const HalfedgeMesh& t, int h, int end) {
  int creases = 0;
  for (int outgoing : t.outgoing(end)) creases += t.is_crease(outgoing);
  return creases == 0 || (creases == 2 && t.is_crease(h));
}

TEST(HalfedgeMesh, SplitsAndCollapsesKeepTheWedges) {
  const test::Triangles cube = test::irregular_cube(4);
  for (unsigned seed = 1; seed <= 4; ++seed) {
    HalfedgeMesh t = triangulate(cube, test::bent_edges(cube.points, cube.faces));
    std::mt19937 random(seed);
    int collapses = 0;
    for (int i = 0; i < 3000; ++i) {
      const int h = static_cast<int>(random() % static_cast<unsigned>(t.half_edge_count()));
      if (t.is_removed(h / 3)) continue;
      if (random() % 3 == 0) {
        t.split(h);
      } else if (is_free_to_go(t, h, t.from(h)) && t.may_collapse(h)) {
        t.collapse(h, t.to(h));
        ++collapses;
      }
    }
    EXPECT_GT(collapses, 300);
    const int vertices = static_cast<int>(t.compact().size());
    std::vector<Edge> creases;
    for (int h = 0; h < t.half_edge_count(); ++h)
      if (t.is_crease(h)) creases.push_back({t.from(h), t.to(h)});
    Adjacency c = make_adjacency(vertices, t.faces());
    split_wedges(c, creases);
    EXPECT_EQ(measure_topology(cut_open(c)).components, 6);
    std::map<int, int> numbers;  // maps the wedges of the half-edge mesh one-to-one to those of the adjacency
    std::set<int> there;
    for (size_t f = 0; f < c.faces.size(); ++f)
      for (size_t k = 0; k < 3; ++k) {
        const auto [wedge, fresh] = numbers.emplace(t.wedges()[f][k], c.wedge_faces[f][k]);
        EXPECT_EQ(wedge->second, c.wedge_faces[f][k]);
        if (fresh) {
          EXPECT_TRUE(there.insert(wedge->second).second);
        }
      }
    EXPECT_EQ(static_cast<int>(there.size()), c.wedge_count());
  }
}

TEST(HalfedgeMesh, ATriangleAndATetrahedronDoNotCollapse) {
  const HalfedgeMesh triangle(make_adjacency(3, {{0, 1, 2}}));
  const HalfedgeMesh tetrahedron(make_adjacency(4, {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}));
  for (const HalfedgeMesh* t : {&triangle, &tetrahedron})
    for (int h = 0; h < t->half_edge_count(); ++h) EXPECT_FALSE(t->may_collapse(h));
}

TEST(HalfedgeMesh, BothHalvesOfAConstrainedEdgeAreConstrained) {
  const test::Triangles ball = test::sphere(1);
  const int a = ball.faces[3][1], b = ball.faces[3][2];
  HalfedgeMesh t = triangulate(ball, {{a, b}});
  const int h = 10;
  ASSERT_TRUE(t.is_crease(h));
  const int v = t.split(h);
  for (const auto& [from, to] : {std::pair(a, v), std::pair(v, b), std::pair(v, a), std::pair(b, v)})
    EXPECT_TRUE(t.is_crease(test::half_edge(t, from, to)));
  EXPECT_EQ(std::ranges::count_if(t.outgoing(v), [&](int s) { return t.is_crease(s); }), 2);
  t.collapse(test::half_edge(t, v, a), a);
  EXPECT_TRUE(t.is_crease(test::half_edge(t, a, b)));
  EXPECT_EQ(t.compact().size(), 42u);
}

TEST(HalfedgeMesh, CompactKeepsWhatHasNoFaces) {
  HalfedgeMesh t(make_adjacency(7, {{1, 2, 3}, {3, 2, 5}, {2, 4, 5}}));
  const int h = test::half_edge(t, 2, 5);
  ASSERT_FALSE(t.may_collapse(h));
  std::vector<int> kept = t.compact();
  std::ranges::sort(kept);
  EXPECT_EQ(kept, (std::vector<int>{0, 1, 2, 3, 4, 5, 6}));
}

TEST(HalfedgeMesh, AFlipJoinsTheCornersAcross) {
  HalfedgeMesh t = triangulate(test::sphere(1));
  const int h = 7, a = t.from(h), b = t.to(h), c = t.opposite_vertex(h), d = t.opposite_vertex(t.twin(h));
  t.flip(h);
  EXPECT_FALSE(t.adjacent(a, b));
  EXPECT_TRUE(t.adjacent(c, d));
  const int f = HalfedgeMesh::flipped(h);
  EXPECT_EQ((std::set{t.from(f), t.to(f)}), (std::set{c, d}));
}

TEST(HalfedgeMesh, OutgoingEdgesRunFromOneBoundaryEdgeToTheOther) {
  const test::Triangles grid = test::grid(2, test::flat);
  const HalfedgeMesh t = triangulate(grid);
  for (int v = 0; v < 9; ++v) {
    const SmallIntList outgoing = t.outgoing(v);
    for (size_t i = 0; i + 1 < outgoing.size(); ++i)
      EXPECT_EQ(t.opposite_vertex(outgoing[i]), t.to(outgoing[i + 1]));
    if (!t.on_boundary(v)) continue;
    EXPECT_EQ(t.twin(outgoing.front()), -1);
    EXPECT_EQ(t.twin(HalfedgeMesh::previous(outgoing.back())), -1);
  }
}

TEST(HalfedgeMesh, AVertexWithoutFacesHasNoOutgoingEdges) {
  const HalfedgeMesh t(make_adjacency(4, {{0, 1, 2}}));
  EXPECT_TRUE(t.outgoing(3).empty());
  EXPECT_EQ(t.valence(3), 0);
}

}  // namespace hooke::halfedge_mesh_test
