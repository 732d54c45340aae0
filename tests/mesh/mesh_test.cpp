#include "hooke/mesh/mesh.h"

#include <gtest/gtest.h>

#include "hooke/core/error.h"
#include "hooke/geometry/triangle.h"
#include "hooke/measure/angle_bound.h"
#include "hooke/measure/deviation.h"
#include "hooke/measure/quality.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/remesh/limiting_factors.h"
#include "hooke/remesh/options.h"
#include "support/remeshed.h"
#include "support/solids.h"

namespace hooke::mesh_test {

const test::Triangles& scattered() {
  static const test::Triangles t = test::shuffled(test::two_parts_and_loose_vertices());
  return t;
}

MeasuredSurface measured(const Mat3X& points, const MemoryOrder& memory_order) {
  return {memory_order.order.gather(points), *memory_order.adjacency, memory_order.order.old_ids()};
}

/// Neighbours, counter-clockwise from the smallest id, or from where a boundary begins.
std::vector<int> ring_of(const TriMesh& mesh, OpenMesh::VertexHandle v) {
  std::vector<int> ring;
  for (const auto w : mesh.vv_ccw_range(v)) ring.push_back(w.idx());
  if (!mesh.is_boundary(v)) std::rotate(ring.begin(), std::ranges::min_element(ring), ring.end());
  return ring;
}

TEST(MemoryOrder, IsTheMeshInMemoryOrder) {
  const TriMesh mesh = test::to_mesh(scattered());
  const MemoryOrder memory_order = find_memory_order(mesh);
  EXPECT_NE(memory_order.adjacency->faces, scattered().faces);
  EXPECT_EQ(memory_order.order.scatter(memory_order.adjacency->faces), scattered().faces);
  EXPECT_EQ(memory_order.order.old_vertex,
            bfs_cluster_order(static_cast<int>(mesh.n_vertices()), scattered().faces));
}

TEST(MemoryOrder, ValuesGoThereAndBack) {
  const MemoryOrder memory_order = find_memory_order(test::to_mesh(scattered()));
  const Mat3X fresh = memory_order.order.gather(scattered().points);
  EXPECT_NE(fresh, scattered().points);
  EXPECT_EQ(memory_order.order.scatter(fresh), scattered().points);
  std::vector<double> values(memory_order.order.old_vertex.size());
  for (size_t v = 0; v < values.size(); ++v) values[v] = fresh(0, static_cast<Eigen::Index>(v));
  const std::vector<double> old = memory_order.order.scatter(values);
  for (size_t v = 0; v < old.size(); ++v)
    EXPECT_EQ(old[v], scattered().points(0, static_cast<Eigen::Index>(v)));
  EXPECT_EQ(memory_order.order.gather(old), values);
}

TEST(MemoryOrder, AMeshBuiltFromItIsTheSameMesh) {
  const TriMesh mesh = test::to_mesh(scattered());
  const MemoryOrder memory_order = find_memory_order(mesh);
  const TriMesh built = build_mesh(scattered().points, *memory_order.adjacency, memory_order.order.old_ids());
  EXPECT_EQ(triangles_of(built), scattered().faces);
  EXPECT_EQ(vertex_points(built), scattered().points);
  ASSERT_EQ(built.n_edges(), mesh.n_edges());
  for (const auto v : mesh.vertices()) {
    EXPECT_EQ(built.is_isolated(v), mesh.is_isolated(v));
    if (mesh.is_isolated(v)) continue;
    EXPECT_EQ(ring_of(built, v), ring_of(mesh, v));
    EXPECT_EQ(built.is_boundary(v), mesh.is_boundary(v));
  }
}

TEST(MemoryOrder, MeasuresNameTheIdsOfTheMesh) {
  const test::Triangles regular = test::shuffled(test::grid(12, test::flat));  // many angles are the same
  int bounded = 0;
  for (const test::Triangles& t : {test::shaken(regular, .02), regular}) {
    const Quality expected = measure_quality(t.points, test::connect(t), {});
    const Quality found = measure_quality(measured(t.points, find_memory_order(test::to_mesh(t))), {});
    ASSERT_EQ(found.worst_faces.size(), expected.worst_faces.size());
    for (size_t i = 0; i < found.worst_faces.size(); ++i) {
      EXPECT_EQ(found.worst_faces[i].face, expected.worst_faces[i].face);
      EXPECT_EQ(found.worst_faces[i].vertices, expected.worst_faces[i].vertices);
      if (expected.worst_faces[i].bound.degrees > 59.999) continue;  // rounding tells whether there is one
      EXPECT_EQ(found.worst_faces[i].bound.vertices, expected.worst_faces[i].bound.vertices);
      ++bounded;
    }
  }
  EXPECT_GT(bounded, 0);
}

TEST(MemoryOrder, DeviationsNameTheIdsOfTheMesh) {
  const test::Triangles t = test::shuffled(test::grid(12, test::flat));
  const MemoryOrder memory_order = find_memory_order(test::to_mesh(t));
  const Adjacency plain = test::connect(t);
  Mat3X folded = t.points;
  const auto inner = static_cast<Eigen::Index>(t.faces[40][0]);
  folded.col(inner) += Vec3(.3, .2, 0);
  const Deviation far = measure_deviation(t.points, plain, folded, plain);
  EXPECT_FALSE(far.opposing_faces.empty());
  EXPECT_EQ(
      measure_deviation(measured(t.points, memory_order), measured(folded, memory_order)).opposing_faces,
      far.opposing_faces);
}

TEST(MemoryOrder, OfAResultIsThatOfTheMeshAsItIs) {
  for (const ConnectivityMode mode :
       {ConnectivityMode::fixed, ConnectivityMode::flip, ConnectivityMode::adapt}) {
    const test::Triangles t = test::shuffled(test::both(test::shaken(test::sphere(2), .04), test::cube()));
    RemeshOptions options;
    options.connectivity = mode;
    options.constraints.features.angle = 60;
    const test::Outcome o = test::remeshed(t, options);
    const MemoryOrder& memory_order = o.result.memory_order;
    EXPECT_EQ(memory_order.order.scatter(memory_order.adjacency->faces), o.faces);
    EXPECT_GT(o.result.creases.edges, 0);
    EXPECT_TRUE(memory_order.adjacency->creases.empty());
    EXPECT_TRUE(memory_order.adjacency->extra_wedges.empty());
  }
}

TEST(MemoryOrder, WhatBoundsTheWorstFacesIsTheSameInAnyOrder) {
  test::Triangles t = test::both(test::shaken(test::sphere(2), .04), test::cube());
  RemeshOptions options;
  options.constraints.features.angle = 60;
  const auto reasons = [&](const test::Triangles& mesh) {
    const test::Outcome o = test::remeshed(mesh, options);
    const Adjacency c = test::connect({o.points, o.faces});
    std::vector<std::vector<std::string>> all;
    for (size_t f = 0; f < c.faces.size(); ++f)
      all.push_back(limiting_factors({.face = static_cast<int>(f),
                                      .min_angle = min_angle(o.points, {c.faces[f]}),
                                      .vertices = c.faces[f],
                                      .bound = bound_min_angle(o.points, c, static_cast<int>(f))},
                                     o.result.vertex_limits));
    std::ranges::sort(all);
    return all;
  };
  const auto expected = reasons(t);
  EXPECT_GT(std::ranges::count_if(expected, [](const auto& r) { return !r.empty(); }), 10);
  EXPECT_EQ(std::ranges::count(expected, std::vector<std::string>{"corner", "crease"}), 12);  // of the cube
  EXPECT_EQ(std::ranges::count(reasons(test::shuffled(t)), std::vector<std::string>{"corner", "crease"}), 12);
}

TEST(MemoryOrder, DisplacementsAreThoseOfTheSameVertices) {
  const test::Triangles t = test::shuffled(test::grid(12, test::flat));
  const Mat3X moved = test::shaken(t, .01).points;
  const Adjacency plain = test::connect(t);
  const MemoryOrder memory_order = find_memory_order(test::to_mesh(t));
  const MaxRms expected = *measure_deviation(t.points, plain, moved, plain).displacement;
  const MaxRms found =
      *measure_deviation(MeasuredSurface(t.points, plain), measured(moved, memory_order)).displacement;
  EXPECT_EQ(found.max, expected.max);
  EXPECT_DOUBLE_EQ(found.rms, expected.rms);
}

TEST(MeshFoundation, TrianglesComeBackAsTheyWentIn) {
  for (const test::Triangles& t : {test::cube(), test::tetrahedron(), test::grid(3, test::flat)}) {
    const TriMesh mesh = test::to_mesh(t);
    EXPECT_EQ(triangles_of(mesh), t.faces);
    EXPECT_EQ(vertex_points(mesh), t.points);
  }
}

TEST(MeshFoundation, PositionsAreTheMeshsOwnStorage) {
  TriMesh mesh = test::to_mesh(test::cube());
  vertex_points(mesh).col(3) = Vec3(7, 8, 9);
  EXPECT_EQ(mesh.point(mesh.vertex_handle(3)), Vec3(7, 8, 9));
  mesh.set_point(mesh.vertex_handle(0), Vec3(-1, -2, -3));
  EXPECT_EQ(vertex_points(mesh).col(0), Vec3(-1, -2, -3));
}

TEST(MeshFoundation, AnEmptyMeshHasEmptyMatrices) {
  TriMesh mesh;
  EXPECT_EQ(vertex_points(mesh).cols(), 0);
  VProp<Vec3> velocity(mesh, velocity_property);
  EXPECT_EQ(as_matrix(mesh, velocity).cols(), 0);
  EXPECT_TRUE(triangles_of(mesh).empty());
}

TEST(MeshFoundation, VerticesWithoutFacesKeepTheirIds) {
  const TriMesh mesh = build_mesh(Mat3X::Random(3, 6), {{1, 3, 5}});
  EXPECT_EQ(mesh.n_vertices(), 6u);
  EXPECT_EQ(triangles_of(mesh), (std::vector<Triangle>{{1, 3, 5}}));
}

TEST(MeshFoundation, ValuesAreStoredByVertexId) {
  TriMesh mesh = test::to_mesh(test::tetrahedron());
  set_vertex_values(mesh, target_length_property, 2.5);
  EXPECT_EQ(vertex_values(mesh, target_length_property), std::vector<double>(4, 2.5));
  set_vertex_values(mesh, target_length_property, 3);
  EXPECT_EQ(vertex_values(mesh, target_length_property), std::vector<double>(4, 3));
}

TEST(MeshFoundation, AMissingPropertyIsAnError) {
  const TriMesh mesh = test::to_mesh(test::tetrahedron());
  EXPECT_THROW(vertex_values(mesh, target_length_property), Error);
}

TEST(MeshFoundation, AFaceThatDoesNotFitIsAnError) {
  // A third face on the edge 0 1, and a second face that runs through it the same way.
  EXPECT_THROW(build_mesh(Mat3X::Random(3, 5), {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}), MeshError);
  EXPECT_THROW(build_mesh(Mat3X::Random(3, 4), {{0, 1, 2}, {0, 1, 3}}), MeshError);
}

}  // namespace hooke::mesh_test
