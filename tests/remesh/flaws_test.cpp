#include "hooke/remesh/flaws.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "hooke/mesh/mesh.h"
#include "hooke/remesh/attempts.h"
#include "hooke/remesh/limiting_factors.h"
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

TEST(Flaws, FoldsAreFoundWhereTheyAreCountedHoweverThinTheFace) {
  for (double height : {1e-2, 1e-8, 1e-13}) {
    test::Triangles t;
    t.points.resize(3, 4);
    t.points << 0, 1, .5, .5, 0, 0, 1, height, 0, 0, 0, 0;
    t.faces = {{0, 1, 2}, {1, 0, 3}};
    const TriMesh mesh = test::with_length(t, 1);
    const MemoryOrder memory_order = find_memory_order(mesh);
    const AttemptMaker maker(mesh, memory_order, {}, {}, {}, nullptr, nullptr, true);
    Attempt attempt;
    attempt.mesh = mesh;
    attempt.result.memory_order = memory_order;
    EXPECT_EQ(maker.input_quality().folded_edges, 1u);
    EXPECT_EQ(folds_off_creases(attempt, maker.input().points).size(), 1u) << height;
  }
}

TEST(Flaws, OfAFoldAllCornersGoBackWhateverWentBackBefore) {
  const TriMesh mesh = test::with_length(test::grid(6, test::flat), 1. / 6);
  const MemoryOrder memory_order = find_memory_order(mesh);
  const Adjacency& c = *memory_order.adjacency;
  const AttemptMaker maker(mesh, memory_order, {}, {}, {}, nullptr, nullptr, true);
  Attempt attempt;
  attempt.mesh = mesh;
  attempt.result.memory_order = memory_order;
  attempt.result.vertex_limits.resize(mesh.n_vertices());
  const Mat3X& points = maker.input().points;
  const auto is_inside = [&](int v) { return (points.col(v) - Vec3(.5, .5, 0)).norm() < .2; };
  const auto inner =
      std::ranges::find_if(c.edges, [&](const Edge& e) { return is_inside(e[0]) && is_inside(e[1]); });
  ASSERT_NE(inner, c.edges.end());
  const Edge edge = *inner;
  const auto [left, right] = c.edge_faces[inner - c.edges.begin()];
  const auto apex = [&](int f) {
    return *std::ranges::find_if(c.faces[f], [&](int v) { return v != edge[0] && v != edge[1]; });
  };
  // The face beside the edge leans over the other one: it folds, but is not turned over as a flat one is.
  const Vec3 middle = (points.col(edge[0]) + points.col(edge[1])) / 2;
  maker.place(apex(left), middle + .3 * (middle - points.col(apex(left))) + Vec3(0, 0, .1), attempt);
  for (int v : edge) attempt.result.vertex_limits[maker.id_of(v)] |= VertexLimit::put_back;
  maker.judge(attempt);
  ASSERT_GT(attempt.preservation().new_folds, 0u);
  const std::vector<int> vertices = vertices_to_put_back(maker, attempt);
  for (int v : {edge[0], edge[1], apex(left), apex(right)})
    EXPECT_TRUE(std::ranges::binary_search(vertices, v));
}

}  // namespace
}  // namespace hooke
