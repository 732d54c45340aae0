#include "hooke/connectivity/junction_edges.h"

#include <gtest/gtest.h>

#include "hooke/mesh/adjacency.h"
#include "hooke/working_mesh/working_mesh.h"
#include "hooke/working_mesh/workspace.h"
#include "support/junction_sheets.h"

namespace hooke::junction_edges_test {

struct Outcome {
  CountChanges changes;
  JunctionCounts before, after;
  Topology topology_before, topology_after;
  JoinedMesh joined;
  Mat3X points;  // of the joined mesh
};

JunctionCounts counts_of(const TriMesh& mesh) {
  const MemoryOrder order = find_memory_order(mesh);
  return count_junctions(*order.adjacency, joined_vertices(mesh, order.order));
}

Topology topology_of(const TriMesh& mesh) {
  const MemoryOrder order = find_memory_order(mesh);
  return measure_topology(*order.adjacency, joined_vertices(mesh, order.order));
}

Outcome matched(const test::Triangles& t, double length, double chord_error = .1,
                const CollapseOptions& collapse = {}) {
  TriMesh mesh = test::sheets(t, length);
  Outcome o;
  o.before = counts_of(mesh);
  o.topology_before = topology_of(mesh);
  Workspace work(mesh, find_memory_order(mesh), {}, {}, {});
  work.set_corner_valences();
  WorkingMesh m(work);
  for (JunctionVertex& v : work.vertices.constraints.junction_vertices) v.slides = v.curve >= 0;  // at bends
  o.changes = match_junction_edges(m, chord_error, collapse);
  compact(m);
  work.replace_mesh(m.halfedges.faces(), m.halfedges.wedges());
  work.copy_back(mesh);
  o.after = counts_of(mesh);
  o.topology_after = topology_of(mesh);
  o.joined = join_sheets(mesh).value();  // throws if the sheets have come apart
  o.points = o.joined.gather(vertex_points(mesh));
  return o;
}

Mat3X line(int edges, double length) {
  std::vector<double> x;
  for (int i = 0; i <= edges; ++i) x.push_back(length * i / edges);
  return test::on_axis(x);
}

void expect_same_network(const Outcome& o) {
  EXPECT_TRUE(o.after.same_network(o.before));
  EXPECT_EQ(o.topology_after.euler, o.topology_before.euler);
  EXPECT_EQ(o.topology_after.components, o.topology_before.components);
  EXPECT_EQ(o.topology_after.boundary_loops, o.topology_before.boundary_loops);
}

TEST(JunctionEdges, OfAFineLineCollapseToTheLength) {
  for (const int sheets : {3, 4}) {
    const Outcome o = matched(test::fan(line(40, 8), sheets, 3, 3), 1);
    expect_same_network(o);
    EXPECT_GT(o.changes.collapses, 20);
    EXPECT_LT(o.after.edges, 20);  // the sheets beside it are as fine still
    for (Eigen::Index v = 0; v < o.points.cols(); ++v) EXPECT_TRUE(o.points.col(v).allFinite());
  }
}

TEST(JunctionEdges, OfACoarseLineAreSplitInAllSheets) {
  const Outcome o = matched(test::fan(line(4, 8), 3, 2, 3), .5);
  expect_same_network(o);
  EXPECT_EQ(o.after.edges, 16);
  EXPECT_EQ(o.changes.splits, 12);
  EXPECT_EQ(o.changes.collapses, 0);
}

TEST(JunctionEdges, OfTheLengthStay) {
  const Outcome o = matched(test::fan(line(8, 8), 3, 3, 3), 1);
  EXPECT_EQ(o.changes.splits + o.changes.collapses, 0);
  EXPECT_EQ(o.after, o.before);
}

TEST(JunctionEdges, NewVerticesLieOnTheCurveOfTheInput) {
  Mat3X arc = line(24, 6);
  for (Eigen::Index i = 0; i < arc.cols(); ++i) arc(1, i) = .05 * arc(0, i) * arc(0, i);
  for (const double length : {.1, 1.}) {
    const Outcome o = matched(test::fan(arc, 3, 3, 1), length);
    expect_same_network(o);
    EXPECT_NE(o.after.edges, o.before.edges);
    const Curve curve = make_curve(arc, false);
    for (Eigen::Index v = 0; v < o.points.cols(); ++v) {
      const Vec3 p = o.points.col(v);
      if (std::abs(p[2]) > 1e-9 || p[1] > .05 * p[0] * p[0] + .1) continue;  // in a sheet
      const int segment = std::clamp(static_cast<int>(p[0] * 4), 0, 23);
      EXPECT_LT((project_to_curve(curve, p, segment).point - p).norm(), 1e-12) << p.transpose();
    }
  }
}

TEST(JunctionEdges, NothingIsJoinedThatChangesTheTopology) {
  // The walls between the cells of a tetrahedron cut at an inner point, whose corners are all nodes.
  test::Triangles t{Mat3X(3, 5), {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  t.points << 1, -1, -1, 1, 0, 1, -1, 1, -1, 0, 1, 1, -1, -1, 0;
  for (const auto& [a, b] : {Edge{0, 1}, Edge{0, 2}, Edge{0, 3}, Edge{1, 2}, Edge{1, 3}, Edge{2, 3}})
    t.faces.push_back({a, b, 4});
  const Outcome o = matched(t, 100);
  EXPECT_EQ(o.changes.collapses, 0);
  EXPECT_EQ(o.after, o.before);
}

/// A ring of `n` edges with a cone on each side of it and one more.
test::Triangles cones(int n) {
  test::Triangles t{Mat3X(3, n + 3), {}};
  for (int i = 0; i < n; ++i) {
    const double turn = 2 * std::numbers::pi * i / n;
    t.points.col(i) << std::cos(turn), std::sin(turn), 0;
  }
  t.points.rightCols(3) << 0, 0, 0, 0, 0, 0, 1, 0, -1;
  for (int apex = n; apex < n + 3; ++apex)
    for (int i = 0; i < n; ++i) t.faces.push_back({i, (i + 1) % n, apex});
  return t;
}

TEST(JunctionEdges, ARingKeepsThreeEdges) {
  const CollapseOptions loose{.longest = 100,
                              .valence = 100,
                              .limits = {.alignment = -1, .fold = -2, .sagitta = 100},
                              .distance = 100};
  const Outcome o = matched(cones(24), 50, 10, loose);
  expect_same_network(o);
  EXPECT_EQ(o.after.curves, 1);
  EXPECT_GE(o.after.edges, 3);
  EXPECT_LT(o.after.edges, 12);
}

}  // namespace hooke::junction_edges_test
