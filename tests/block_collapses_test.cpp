#include "hooke/connectivity/collapse_passes.h"

#include <gtest/gtest.h>

#include "adapting_scene.h"
#include "hooke/core/parallel.h"
#include "hooke/mesh/topology.h"

namespace hooke {
namespace {

constexpr int cells = 24;
constexpr int side = cells + 1;
constexpr BlockOptions blocks{.vertices = 5 * side, .passes = 1};  // of five rows

/// A grid that is far too fine.
struct FineGrid : test::AdaptingScene {
  explicit FineGrid(double times = 5) : AdaptingScene(test::grid(cells, test::flat, .3), test::plane()) {
    for (double& length : vertex_length) length *= times;
    count_curve_edges(adapting, .1);
  }
};

int rows_from_other_blocks(int vertex) {
  const int row = vertex / side % 5;
  return std::min(vertex / side < 5 ? 5 : row, vertex / side >= cells / 5 * 5 ? 5 : 4 - row);
}

TEST(BlockCollapses, LeaveWhatLiesAboutOtherBlocks) {
  FineGrid s;
  const Mat3X before = s.placement.points;
  const int collapses = collapse_in_blocks(s.adapting, {}, blocks);
  EXPECT_GT(collapses, cells);
  int gone = 0;
  for (int v = 0; v < side * side; ++v) {
    gone += s.triangulation.valence(v) < 0;
    if (rows_from_other_blocks(v) >= 2) continue;
    EXPECT_GT(s.triangulation.valence(v), 0) << v;
    EXPECT_EQ(Vec3(s.placement.points.col(v)), Vec3(before.col(v))) << v;
  }
  EXPECT_EQ(gone, collapses);
}

TEST(BlockCollapses, ReachFartherInFurtherPasses) {
  FineGrid once, thrice;
  BlockOptions more = blocks;
  more.passes = 3;
  EXPECT_GT(collapse_in_blocks(thrice.adapting, {}, more), collapse_in_blocks(once.adapting, {}, blocks));
}

TEST(BlockCollapses, KeepTopologyBoundaryAndLengthsThatMayStay) {
  FineGrid s;
  BlockOptions more = blocks;
  more.passes = 3;
  collapse_in_blocks(s.adapting, {}, more);
  for (int v = 0; v < side * side; ++v)
    if (v % side == 0 || v % side == cells || v < side || v >= cells * side) {
      EXPECT_GT(s.triangulation.valence(v), 0) << v;
    }
  compact(s.adapting);
  const Connectivity c =
      make_connectivity(static_cast<int>(s.placement.points.cols()), s.triangulation.faces());
  EXPECT_EQ(measure_topology(c).euler, 1);
  EXPECT_EQ(measure_topology(c).components, 1);

  FineGrid barely(1.5);  // no edge is shorter than a tenth of what may stay
  EXPECT_EQ(collapse_in_blocks(barely.adapting, {}, {.vertices = blocks.vertices, .part = .1, .share = 0}),
            0);
}

/// Of triangles with two equal sides: an inner edge may come to lie on the boundary and be as long as before.
TEST(BlockCollapses, LeaveCurvesTheirEdges) {
  test::Triangles even = test::grid(cells, test::flat);
  for (int v = 0; v < side * side; ++v) even.points.col(v) = Vec3(v % side - .5 * (v / side), v / side, 0);
  test::AdaptingScene s(even, test::plane());
  for (double& length : s.vertex_length) length *= 5;
  count_curve_edges(s.adapting, .1);
  const std::vector<int> present = s.curve_edges.present;
  EXPECT_GT(collapse_in_blocks(s.adapting, {.valence = 12}, {.vertices = 12 * side}), cells);
  EXPECT_EQ(s.curve_edges.present, present);
  for (int v = 0; v < side * side; ++v)
    if (v % side == 0 || v % side == cells || v < side || v >= cells * side) {
      EXPECT_GT(s.triangulation.valence(v), 0) << v;
    }
}

TEST(BlockCollapses, DoNotDependOnThreads) {
  std::vector<Mat3X> points;
  std::vector<std::vector<Triangle>> faces;
  for (int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    FineGrid s;
    BlockOptions more = blocks;
    more.passes = 3;
    collapse_in_blocks(s.adapting, {}, more);
    points.push_back(s.placement.points);
    faces.push_back(s.triangulation.faces());
  }
  EXPECT_EQ(points[0], points[1]);
  EXPECT_EQ(faces[0], faces[1]);
}

TEST(BlockCollapses, AreForManyShortEdgesOnly) {
  FineGrid small, few;
  EXPECT_EQ(collapse_in_blocks(small.adapting, {}, {.vertices = side * side}), 0);
  EXPECT_EQ(collapse_in_blocks(few.adapting, {}, {.vertices = blocks.vertices, .share = 1.01}), 0);
}

}  // namespace
}  // namespace hooke
