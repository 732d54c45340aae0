#include "hooke/working_mesh/vertex_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "hooke/working_mesh/working_mesh.h"
#include "support/working_scene.h"

namespace hooke::vertex_table_test {
namespace {

/// A ridge along the middle row of a grid, so that its vertices have two wedges, with data that tell each
/// row from all others.
test::WorkingScene ridge() {
  constexpr int n = 6, middle = (n + 1) * n / 2;
  std::vector<Edge> creases;
  for (int i = 0; i < n; ++i) creases.push_back({middle + i, middle + i + 1});
  return {test::grid(n, test::flat), test::plane(), creases};
}

void number_rows(VertexTable& t) {
  std::iota(t.vertex_length.begin(), t.vertex_length.end(), 1.);
  std::iota(t.origins.begin(), t.origins.end(), 0);
  std::iota(t.previous_ids.begin(), t.previous_ids.end(), 0);
  std::iota(t.corner_valences.begin(), t.corner_valences.end(), 0);
  std::iota(t.positions.hints.begin(), t.positions.hints.end(), 0);
  std::iota(t.positions.segments.begin(), t.positions.segments.end(), 0);
  std::iota(t.positions.drift.begin(), t.positions.drift.end(), 0.);
  std::iota(t.constraints.curve.begin(), t.constraints.curve.end(), 0);
}

void expect_equal(const VertexTable& a, const VertexTable& b) {
  EXPECT_EQ(a.positions.points, b.positions.points);
  EXPECT_EQ(a.positions.normals, b.positions.normals);
  EXPECT_EQ(a.positions.hints, b.positions.hints);
  EXPECT_EQ(a.positions.segments, b.positions.segments);
  EXPECT_EQ(a.positions.drift, b.positions.drift);
  EXPECT_EQ(a.constraints.freedom, b.constraints.freedom);
  EXPECT_EQ(a.constraints.curve, b.constraints.curve);
  EXPECT_EQ(a.vertex_length, b.vertex_length);
  EXPECT_EQ(a.origins, b.origins);
  EXPECT_EQ(a.previous_ids, b.previous_ids);
  EXPECT_EQ(a.corner_valences, b.corner_valences);
}

std::vector<int> ids(int count) {
  std::vector<int> all(count);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

TEST(VertexTable, KeepingAllRowsInTheirOrderChangesNothing) {
  test::WorkingScene s = ridge();
  VertexTable& t = s.vertices;
  number_rows(t);
  VertexTable before = t;
  t.keep(ids(s.adjacency.vertex_count), ids(s.adjacency.wedge_count()), t.constraints.extra_wedges);
  expect_equal(t, before);
  EXPECT_EQ(t.positions.other_wedge, before.positions.other_wedge);
}

TEST(VertexTable, AllColumnsKeepTheSameRows) {
  test::WorkingScene s = ridge();
  VertexTable& t = s.vertices;
  number_rows(t);
  const VertexTable before = t;
  std::vector<int> vertices = ids(s.adjacency.vertex_count), wedges = ids(s.adjacency.wedge_count());
  std::ranges::reverse(vertices);
  std::ranges::reverse(wedges);
  t.keep(vertices, wedges, {});
  for (size_t i = 0; i < vertices.size(); ++i) {
    const int row = vertices[i];
    EXPECT_EQ(t.positions.points.col(static_cast<Eigen::Index>(i)), before.positions.points.col(row));
    EXPECT_EQ(t.positions.segments[i], row);
    EXPECT_EQ(t.positions.drift[i], row);
    EXPECT_EQ(t.constraints.freedom[i], before.constraints.freedom[row]);
    EXPECT_EQ(t.constraints.curve[i], row);
    EXPECT_EQ(t.vertex_length[i], row + 1);
    EXPECT_EQ(t.origins[i], row);
    EXPECT_EQ(t.previous_ids[i], row);
  }
  for (size_t i = 0; i < wedges.size(); ++i) {
    EXPECT_EQ(t.positions.hints[i], wedges[i]);
    EXPECT_EQ(t.corner_valences[i], wedges[i]);
  }
}

TEST(VertexTable, NewRowsStandStillAndAreNew) {
  test::WorkingScene s = ridge();
  VertexTable& t = s.vertices;
  const size_t last = s.adjacency.wedge_count();
  t.resize(s.adjacency.wedge_count() + 1);
  EXPECT_EQ(t.constraints.freedom[last], Freedom::fixed);
  EXPECT_EQ(t.constraints.curve[last], -1);
  EXPECT_EQ(t.origins[last], -1);
  EXPECT_EQ(t.previous_ids[last], -1);
  EXPECT_EQ(t.positions.other_wedge_of(static_cast<int>(last)), -1);
  EXPECT_GT(t.positions.points.cols(), static_cast<Eigen::Index>(last));
}

TEST(VertexTable, CompactingAMeshKeepsRowsTogether) {
  test::WorkingScene s = ridge();
  number_rows(s.vertices);
  const Mat3X before = s.vertices.positions.points;
  compact(s.mesh);
  const VertexTable& t = s.vertices;
  ASSERT_EQ(t.previous_ids.size(), before.cols());
  for (size_t i = 0; i < t.previous_ids.size(); ++i) {
    const int row = t.previous_ids[i];
    EXPECT_EQ(t.positions.points.col(static_cast<Eigen::Index>(i)), before.col(row));
    EXPECT_EQ(t.positions.segments[i], row);
    EXPECT_EQ(t.constraints.curve[i], row);
    EXPECT_EQ(t.origins[i], row);
  }
}

}  // namespace
}  // namespace hooke::vertex_table_test
