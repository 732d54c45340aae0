#include "hooke/remesh/flaws.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "hooke/mesh/mesh.h"
#include "hooke/remesh/attempts.h"
#include "support/meshes.h"
#include "support/remeshed.h"
#include "support/solids.h"

namespace hooke {
namespace {

TEST(Flaws, AreAtFacesThatLoseTheirArea) {
  const TriMesh mesh = test::with_length(test::grid(6, test::flat), 1. / 6);
  const MemoryOrder memory_order = find_memory_order(mesh);
  const Adjacency& c = *memory_order.adjacency;
  RemeshOptions options;
  options.connectivity = ConnectivityMode::adapt;
  const AttemptMaker maker(mesh, memory_order, options, {}, {}, nullptr, nullptr, true);
  Attempt attempt;
  attempt.mesh = mesh;
  attempt.result.memory_order = memory_order;
  attempt.result.vertex_limits.resize(mesh.n_vertices());
  maker.judge(attempt);
  ASSERT_EQ(attempt.flaws(), 0u);
  int corner = 0;  // of the sheet, in one face
  while (c.vertex_faces[corner].size() > 1) ++corner;
  const std::vector<int> ends(c.vertex_neighbours[corner].begin(), c.vertex_neighbours[corner].end());
  const Mat3X& points = maker.input().points;
  maker.place(corner, (points.col(ends[0]) + points.col(ends[1])) / 2, attempt);
  maker.judge(attempt);
  ASSERT_EQ(attempt.preservation().new_degenerate_faces, 1u);
  ASSERT_EQ(attempt.flaws(), 1u);
  const std::vector<int> vertices = input_vertices_at_flaws(maker, attempt);
  for (int v : ends) EXPECT_TRUE(std::ranges::binary_search(vertices, v));
  EXPECT_LT(vertices.size(), 8u);
}

}  // namespace
}  // namespace hooke
