#include "target_lengths.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "hooke/core/error.h"
#include "hooke/springs/sizing.h"
#include "support/errors.h"
#include "support/solids.h"
#include "support/temporary_folder.h"

namespace hooke::app::target_lengths_test {

MemoryOrder layout_of(const test::Triangles& t) {
  return find_memory_order(test::to_mesh(t));
}

TEST(ReadSizing, APropertyIsOfAPlyFileOnly) {
  const test::Triangles t = test::tetrahedron();
  EXPECT_ERROR(Error, "m.obj: sizing by the property 'size'",
               read_sizing(parse_sizing("ply:size"), "m.obj", t.points, layout_of(t)));
}

TEST(ReadSizing, AFileThatHasChangedInBetweenIsToldApart) {
  const test::TemporaryFolder folder;
  test::write_text(folder / "m.ply",
                   "ply\nformat ascii 1.0\nelement vertex 1\nproperty float size\nend_header\n1\n");
  const test::Triangles t = test::tetrahedron();
  EXPECT_ERROR(InputError, (folder / "m.ply").string() + ": 1 vertices, and 4 when it was first read",
               read_sizing(parse_sizing("ply:size"), folder / "m.ply", t.points, layout_of(t)));
}

TEST(ReadSizing, AListFollowsTheMeshAndItsLengthsTheLayout) {
  const test::TemporaryFolder folder;
  const test::Triangles t = test::shuffled(test::sphere(1));
  std::string lines;
  for (Eigen::Index v = 0; v < t.points.cols(); ++v) lines += std::to_string(v + 1) + "\n";
  test::write_text(folder / "lengths.txt", lines);
  const MemoryOrder memory_order = layout_of(t);
  const std::vector<double> lengths =
      read_sizing(parse_sizing((folder / "lengths.txt").string()), "", t.points, memory_order);
  ASSERT_EQ(lengths.size(), memory_order.order.old_vertex.size());
  EXPECT_FALSE(std::ranges::is_sorted(lengths));
  for (size_t v = 0; v < lengths.size(); ++v) EXPECT_EQ(lengths[v], memory_order.order.old_vertex[v] + 1);
}

TEST(ReadSizing, CurvatureOfASphereGivesTheChordOfItsCircle) {
  test::Triangles t = test::sphere(3, .3, 1);
  t.points *= 3;
  const double error = .05, expected = std::sqrt(8 * 3 * error - 4 * error * error);
  const MemoryOrder memory_order = layout_of(t);
  const Mat3X points = memory_order.order.gather(t.points);
  for (double l : read_sizing(parse_sizing("curvature:.05"), "", points, memory_order))
    EXPECT_NEAR(l, std::min(expected, 1.0392), .03 * expected);
}

TEST(ReadSizing, OnAPlaneNoLengthIsOverATenthOfTheDiagonal) {
  const test::Triangles t = test::grid(5, test::flat);
  const MemoryOrder memory_order = layout_of(t);
  const Mat3X points = memory_order.order.gather(t.points);
  for (double l : read_sizing(parse_sizing("curvature"), "", points, memory_order))
    EXPECT_DOUBLE_EQ(l, .1 * std::sqrt(2));
}

TEST(ReadSizing, WithoutOneThereAreNoLengths) {
  const test::Triangles t = test::grid(5, test::flat);
  EXPECT_TRUE(read_sizing({}, "", t.points, layout_of(t)).empty());
}

}  // namespace hooke::app::target_lengths_test
