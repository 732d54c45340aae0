#include "hooke/mesh/junctions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "hooke/core/error.h"
#include "hooke/mesh/halfedge_mesh.h"
#include "hooke/mesh/repair.h"
#include "support/meshes.h"
#include "support/solids.h"

namespace hooke::junctions_test {

constexpr RepairOptions keep{.keep_junctions = true};

/// A mesh that need not be a manifold, as the sheets that it is worked on as.
struct Sheets {
  Mat3X points;
  std::vector<Triangle> faces;
  std::vector<int> joined;
  Adjacency adjacency;
};

Sheets sheets_of(const test::Triangles& t) {
  Repaired r = repair(t.points, t.faces, keep, {"m", {}, {}});
  Adjacency c = make_adjacency(static_cast<int>(r.points.cols()), r.triangles);
  return {std::move(r.points), std::move(r.triangles), std::move(r.origin.joined), std::move(c)};
}

/// `count` triangles on the edge 0-1.
test::Triangles book(int count) {
  test::Triangles t{Mat3X(3, 2 + count), {}};
  t.points.leftCols(2) << 0, 0, 0, 0, 0, 1;
  for (int k = 0; k < count; ++k) {
    const double turn = 2 * std::numbers::pi * k / count;
    t.points.col(2 + k) << std::cos(turn), std::sin(turn), .5;
    t.faces.push_back({0, 1, 2 + k});
  }
  return t;
}

/// All faces of the four tetrahedra about the middle of one.
test::Triangles foam() {
  test::Triangles t = test::tetrahedron();
  t.points.conservativeResize(3, 5);
  t.points.col(4).setZero();
  for (const auto& [a, b] : {Edge{0, 1}, Edge{0, 2}, Edge{0, 3}, Edge{1, 2}, Edge{1, 3}, Edge{2, 3}})
    t.faces.push_back({a, b, 4});
  return t;
}

test::Triangles touching_tetrahedra() {
  test::Triangles t = test::tetrahedron();
  t.points.conservativeResize(3, 7);
  for (int v = 1; v < 4; ++v) t.points.col(v + 3) = 2 * t.points.col(0) - t.points.col(v);
  for (Triangle face : test::tetrahedron().faces) {
    for (int& v : face) v = v == 0 ? 0 : v + 3;
    std::swap(face[1], face[2]);
    t.faces.push_back(face);
  }
  return t;
}

TEST(Junctions, AManifoldHasNone) {
  const Sheets s = sheets_of(test::sphere(1));
  EXPECT_TRUE(s.joined.empty());
  EXPECT_TRUE(find_junctions(s.adjacency, s.joined).edges.empty());
  EXPECT_EQ(count_junctions(s.adjacency, s.joined), JunctionCounts());
}

TEST(Junctions, FacesStayAsTheyAreAndCopiesComeLast) {
  for (const test::Triangles& t : {book(3), book(6), foam(), touching_tetrahedra()}) {
    const Sheets s = sheets_of(t);
    EXPECT_EQ(join_faces(s.faces, s.joined), t.faces);
    for (int v = 0; v < s.points.cols(); ++v) {
      EXPECT_EQ(s.points.col(v), s.points.col(s.joined[v]));
      EXPECT_TRUE(v < t.points.cols() ? s.joined[v] == v : s.joined[v] < t.points.cols());
    }
  }
}

TEST(Junctions, AreCountedWithTheirFaces) {
  const Sheets s = sheets_of(book(5));
  EXPECT_EQ(find_junctions(s.adjacency, s.joined).edges.size(), 5u);  // one on each sheet
  EXPECT_EQ(count_junctions(s.adjacency, s.joined),
            (JunctionCounts{.edges = 1, .curves = 1, .nodes = 2, .faces = {0, 0, 0, 0, 0, 1}}));
}

TEST(Junctions, NodesAreWhereCurvesMeet) {
  const Sheets s = sheets_of(foam());
  const JunctionCounts counts = count_junctions(s.adjacency, s.joined);
  EXPECT_EQ(counts.edges, 10);  // six of the tetrahedron and four to its middle, all of three faces
  EXPECT_EQ(counts.faces, (std::vector<int>{0, 0, 0, 10}));
  EXPECT_EQ(counts.nodes, 5);
  EXPECT_EQ(counts.curves, 10);
}

TEST(Junctions, TopologyIsThatOfTheJoinedMesh) {
  const Sheets foam_sheets = sheets_of(foam());
  const Topology t = measure_topology(foam_sheets.adjacency, foam_sheets.joined);
  EXPECT_EQ(t.vertices, 5);
  EXPECT_EQ(t.edges, 10);
  EXPECT_EQ(t.faces, 10);
  EXPECT_EQ(t.euler, 5);  // 1 + the number of cells
  EXPECT_EQ(t.components, 1);
  EXPECT_EQ(t.boundary_edges, 0);
  EXPECT_EQ(t.junction_edges, 10);
  const Valence valence = count_valences(foam_sheets.adjacency, foam_sheets.joined);
  EXPECT_EQ(valence.interior, (std::vector<int>{0, 0, 0, 0, 5}));

  const Sheets pair = sheets_of(touching_tetrahedra());
  const Topology touching = measure_topology(pair.adjacency, pair.joined);
  EXPECT_EQ(touching.vertices, 7);
  EXPECT_EQ(touching.components, 1);
  EXPECT_EQ(touching.euler, 3);
  EXPECT_EQ(touching.junction_edges, 0);
  EXPECT_EQ(find_junctions(pair.adjacency, pair.joined).vertices, (std::vector<int>{0, 7}));
}

TEST(Junctions, EachEdgeIsCountedOnce) {
  const Sheets s = sheets_of(book(4));
  const std::vector<char> first = first_of_joined(s.adjacency, s.joined);
  EXPECT_EQ(std::accumulate(first.begin(), first.end(), 0), 9);
}

TEST(Junctions, WhatElseIsWrongIsLeftToValidation) {
  test::Triangles t = foam();
  std::swap(t.faces.back()[0], t.faces.back()[1]);  // at edges of three faces any direction will do
  EXPECT_FALSE(sheets_of(t).joined.empty());
  test::Triangles turned = test::grid(3, test::flat);
  turned.points.conservativeResize(3, turned.points.cols() + 1);
  turned.points.rightCols(1) << 0, 0, 1;
  turned.faces.push_back({5, 6, static_cast<int>(turned.points.cols()) - 1});
  std::swap(turned.faces[0][0], turned.faces[0][1]);
  EXPECT_TRUE(repair(turned.points, turned.faces, keep, {"m", {}, {}}).origin.joined.empty());
}

TEST(Junctions, AOneSidedSurfaceIsCutWhereItCannotBeOriented) {
  const int n = 12;
  test::Triangles t{Mat3X(3, 2 * n), {}};
  for (int k = 0; k < n; ++k) {
    const double u = 2 * std::numbers::pi * k / n;
    for (int side = 0; side < 2; ++side) {
      const double w = side == 0 ? -.3 : .3, r = 1 + w * std::cos(u / 2);
      t.points.col(2 * k + side) << r * std::cos(u), r * std::sin(u), w * std::sin(u / 2);
    }
    const int a = 2 * k, b = 2 * k + 1, c = k + 1 < n ? a + 2 : 1, d = k + 1 < n ? a + 3 : 0;
    t.faces.push_back({a, c, b});
    t.faces.push_back({b, c, d});
  }
  const Repaired r = repair(t.points, t.faces, {.repair = true, .keep_junctions = true}, {"m", {}, {}});
  ASSERT_FALSE(r.origin.joined.empty());
  const Adjacency c = make_adjacency(static_cast<int>(r.points.cols()), r.triangles);
  EXPECT_EQ(measure_topology(c, r.origin.joined).vertices, 2 * n);
  EXPECT_EQ(measure_topology(c, r.origin.joined).boundary_loops, 1);
  EXPECT_EQ(measure_topology(c, r.origin.joined).euler, 0);
}

TEST(Junctions, AnyTrianglesBecomeManifoldSheetsThatJoinToThem) {
  std::mt19937 random(1);
  for (int round = 0; round < 300; ++round) {
    const int vertices = 4 + round % 9, faces = 1 + round % 40;
    test::Triangles t{Mat3X::Random(3, vertices), {}};
    std::uniform_int_distribution<int> vertex(0, vertices - 1);
    for (int f = 0; f < faces; ++f) t.faces.push_back({vertex(random), vertex(random), vertex(random)});
    const Repaired r = repair(t.points, t.faces, {.repair = true, .keep_junctions = true}, {"m", {}, {}});
    for (const Problem& problem : find_problems(r.points, r.triangles))
      EXPECT_TRUE(is_acceptable(problem.kind) || problem.kind == ProblemKind::no_faces)
          << round << ' ' << name_of(problem.kind);
    const std::vector<Triangle> joined = join_faces(r.triangles, r.origin.joined);
    for (std::size_t f = 0; f < joined.size(); ++f) {
      Triangle now = joined[f], before = t.faces[r.origin.face[f]];
      for (int& v : now) v = r.origin.vertex[v];
      std::ranges::sort(now);
      std::ranges::sort(before);
      EXPECT_EQ(now, before);
    }
  }
}

TEST(Junctions, TheirNetworkMayHaveOtherEdges) {
  const JunctionCounts one{.edges = 3, .curves = 1, .nodes = 2, .faces = {0, 0, 0, 3}};
  JunctionCounts split = one;
  split.edges = split.faces[3] = 6;
  EXPECT_TRUE(one.same_network(split));
  split.faces = {0, 0, 0, 5, 1};
  EXPECT_FALSE(one.same_network(split));
  split = one;
  split.curves = 2;
  EXPECT_FALSE(one.same_network(split));
}

TEST(Junctions, ANewEdgeJoinsTwoPlacesOfOneSheetOnly) {
  const test::Triangles grid = test::grid(2, test::flat);
  const auto count = static_cast<int>(grid.points.cols());
  const Adjacency c = test::connect(test::both(grid, grid));
  HalfedgeMesh t(c);
  int apart = 0;
  for (int h = 0; h < t.half_edge_count() / 2; ++h) {  // of the first sheet
    if (t.twin(h) < 0) continue;
    const int a = t.opposite_vertex(h), b = t.opposite_vertex(t.twin(h));
    if (t.adjacent(a, b)) continue;
    ++apart;
    std::vector<int> place(c.vertex_count, -1);
    place[a] = place[a + count] = 0;
    place[b] = 1;
    t.mark_junctions(place);
    EXPECT_TRUE(t.may_connect(a, b));
    place[b + count] = 1;
    t.mark_junctions(place);
    EXPECT_FALSE(t.may_connect(a, b));
    place[b + count] = -1;
    place[t.from(h)] = 1;  // two copies in one sheet
    t.mark_junctions(place);
    EXPECT_FALSE(t.may_connect(a, b));
    t.mark_junctions({});
    EXPECT_TRUE(t.may_connect(a, b));
  }
  EXPECT_GT(apart, 0);
}

TEST(Junctions, NoCollapseMakesAFaceThatAnotherSheetMayHave) {
  const std::vector<Triangle> faces = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {4, 5, 7}, {5, 6, 7}, {6, 4, 7}};
  HalfedgeMesh t(make_adjacency(8, faces));
  const int h = t.half_edge(3, 0);
  t.mark_junctions({0, 1, 2, -1, 0, 1, 2, -1});
  EXPECT_FALSE(t.may_collapse(h));
  t.mark_junctions({0, 1, 2, -1, 0, 3, 2, -1});
  EXPECT_TRUE(t.may_collapse(h));
}

TEST(Junctions, NoCollapseMergesTwoOfTheirPlaces) {
  const test::Triangles grid = test::grid(4, test::flat);
  const Adjacency c = test::connect(grid);
  HalfedgeMesh t(c);
  int inner = 0;
  for (int h = 0; h < t.half_edge_count(); ++h) {
    if (t.twin(h) < 0 || !t.may_collapse(h)) continue;
    ++inner;
    std::vector<int> place(c.vertex_count, -1);
    place[t.from(h)] = 0;
    t.mark_junctions(place);
    EXPECT_TRUE(t.may_collapse(h));
    place[t.to(h)] = 1;
    t.mark_junctions(place);
    EXPECT_FALSE(t.may_collapse(h));
    t.mark_junctions({});
  }
  EXPECT_GT(inner, 0);
}

TEST(Junctions, JoinedSheetsMustNotHaveComeApart) {
  Sheets s = sheets_of(book(3));
  TriMesh mesh = build_mesh(s.points, s.faces);
  EXPECT_FALSE(join_sheets(mesh));
  set_joined_vertices(mesh, s.joined);
  const std::optional<JoinedMesh> joined = join_sheets(mesh);
  ASSERT_TRUE(joined);
  EXPECT_EQ(joined->vertices.size(), 5u);
  EXPECT_EQ(joined->triangles, book(3).faces);
  EXPECT_EQ(joined->scatter(joined->gather(vertex_points(mesh))), vertex_points(mesh));
  vertex_points(mesh)(0, s.points.cols() - 1) += 1e-15;
  EXPECT_THROW(join_sheets(mesh), ResultError);
}

TEST(Junctions, AJoinedVertexHasTheMeanNormal) {
  const Sheets s = sheets_of(book(3));
  TriMesh mesh = build_mesh(s.points, s.faces);
  set_joined_vertices(mesh, s.joined);
  VertexData data = {{"nx"}, {"ny"}, {"nz"}};
  for (VertexChannel& channel : data) channel.values.assign(s.joined.size(), 0);
  Mat3X normals = Mat3X::Zero(3, std::ssize(s.joined));
  normals.row(0).setOnes();
  for (std::size_t v = 0; v < s.joined.size(); ++v)
    if (s.joined[v] != static_cast<int>(v)) normals.col(static_cast<Eigen::Index>(v)) = Vec3(0, 1, 0);
  set_normals(data, normals);
  const VertexData joined = join_sheets(mesh)->gather(data);
  EXPECT_NEAR(joined[0].values[0], 1 / std::sqrt(5.), 1e-15);  // one copy looks along x, two along y
  EXPECT_NEAR(joined[1].values[0], 2 / std::sqrt(5.), 1e-15);
  EXPECT_EQ(joined[0].values[2], 1);
}

}  // namespace hooke::junctions_test
