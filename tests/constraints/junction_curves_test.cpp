#include "hooke/constraints/junction_curves.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "hooke/integrator/gauss_seidel.h"
#include "hooke/integrator/guards.h"
#include "hooke/springs/energy.h"
#include "hooke/working_mesh/workspace.h"
#include "support/junction_sheets.h"
#include "support/remeshed.h"
#include "support/scene.h"

namespace hooke::junction_curves_test {

Workspace on(const test::Triangles& t, const ConstraintOptions& options = {}) {
  const TriMesh mesh = test::sheets(t, 1);
  return Workspace(mesh, find_memory_order(mesh), options, {}, {});
}

test::Triangles uneven() {
  return test::fan(test::on_axis({0, .7, 1.4, 3, 4.2, 5, 6.3, 7}), 3, 3, 3);
}

/// The ids in the file of the vertices that slide, those of the first copies.
std::vector<int> sliding(const Workspace& work) {
  std::vector<int> ids;
  for_each_sliding(work.vertices.constraints, [&](std::span<const int> copies) {
    int first = work.order.old_vertex[copies.front()];
    for (const int v : copies) first = std::min(first, work.order.old_vertex[v]);
    ids.push_back(first);
  });
  std::ranges::sort(ids);
  return ids;
}

/// Are all copies in the same place, and in that of a point of the x axis?
bool stay_joined_on_axis(const Workspace& work, const Mat3X& input) {
  const Mat3X& points = work.vertices.positions.points;
  bool joined = true;
  for_each_sliding(work.vertices.constraints, [&](std::span<const int> copies) {
    const Vec3 x = work.normalisation.centre + work.normalisation.unit * points.col(copies.front());
    joined &= copies.size() == 3 && (x.tail(2) - input.col(0).tail(2)).norm() < 1e-12;
    for (const int v : copies) joined &= points.col(v) == points.col(copies.front());
  });
  return joined;
}

TEST(JunctionCurves, VerticesSlideBetweenTheEnds) {
  const Workspace work = on(uneven());
  const Constraints& c = work.vertices.constraints;
  EXPECT_EQ(sliding(work), (std::vector<int>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(c.junction_curves.size(), 1u);
  EXPECT_EQ(c.junction_edges.size(), 7u);
  for (const JunctionEdge& edge : c.junction_edges) EXPECT_EQ(edge.curve, 0);
  for (std::size_t v = 0; v < c.freedom.size(); ++v)
    EXPECT_TRUE(c.junction[v] < 0 || c.freedom[v] == Freedom::fixed);  // for what moves vertices one by one
}

TEST(JunctionCurves, EndAtSharpTurnsAndAtVerticesThatAreHeld) {
  Mat3X line = test::on_axis({0, .7, 1.4, 3, 4.2, 5, 6.3, 7});
  for (int i = 4; i < 8; ++i) line(1, i) = line(0, i) - 3;  // turns by 45 degrees at 3
  EXPECT_EQ(sliding(on(test::fan(line, 3, 3, 3))), (std::vector<int>{1, 2, 4, 5, 6}));
  EXPECT_EQ(sliding(on(uneven(), {.fixed_vertices = {2}})), (std::vector<int>{1, 3, 4, 5, 6}));
}

TEST(JunctionCurves, EndWhereAnotherSheetOnlyTouches) {
  test::Triangles t = uneven();
  const int n = static_cast<int>(t.points.cols());
  t.points.conservativeResize(3, n + 2);
  t.points.rightCols(2) << 3, 3, 1, 2, 3, 3;
  t.faces.push_back({3, n, n + 1});
  EXPECT_EQ(sliding(on(t)), (std::vector<int>{1, 2, 4, 5, 6}));
}

TEST(JunctionCurves, EvenCurvesKeepTheirBends) {
  Mat3X line = test::on_axis({0, 1, 2, 3, 4, 5, 6});
  for (int i = 0; i < 7; ++i) line(1, i) = .04 * line(0, i) * line(0, i);
  const Workspace even = on(test::fan(line, 3, 3, 3));
  EXPECT_TRUE(sliding(even).empty());
  EXPECT_EQ(even.vertices.constraints.junction_curves.size(), 1u);
  EXPECT_EQ(sliding(on(test::fan(line, 3, 3, 3), {.even_crease = 0})), (std::vector<int>{1, 2, 3, 4, 5}));
}

TEST(JunctionCurves, AStepMovesAllCopiesAlike) {
  Workspace work = on(uneven());
  const Mat3X u = test::random_vectors(work.start->cols(), .2);  // not constrained
  SurfacePositions to;
  work.retraction->step(work.vertices.positions, u, to);
  EXPECT_NE(to.points, work.vertices.positions.points);
  work.vertices.positions = to;
  EXPECT_TRUE(stay_joined_on_axis(work, uneven().points));
}

TEST(JunctionCurves, GuardsShortenTheStepsOfAllCopies) {
  Workspace work = on(uneven());
  const Guards guards(*work.adjacency, work.targets, {});
  Mat3X u = test::random_vectors(work.start->cols(), 1.5);
  work.retraction->constrain(work.vertices.positions, u);
  SurfacePositions to;
  EXPECT_FALSE(guards.step(*work.retraction, work.vertices.positions, u, to).empty());
  work.vertices.positions = to;
  EXPECT_TRUE(stay_joined_on_axis(work, uneven().points));
  EXPECT_TRUE(guards.folded_faces(to).empty());
}

TEST(JunctionCurves, SweepsLowerTheEnergyOfAllSheets) {
  Workspace work = on(uneven());
  Relaxation r(work, {}, {});
  const double before = r.present_energy();
  const std::vector<double> moves = local_newton_sweep(r, {}, {});
  EXPECT_LT(r.present_energy(), before);
  EXPECT_TRUE(stay_joined_on_axis(work, uneven().points));
  int moved = 0;
  for_each_sliding(work.vertices.constraints, [&](std::span<const int> copies) {
    moved += moves[copies.front()] > 0;
    for (const int v : copies) EXPECT_EQ(moves[v], moves[copies.front()]);
  });
  EXPECT_GE(moved, 4);
}

}  // namespace hooke::junction_curves_test
