#include "hooke/io/read_mesh.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

#include "hooke/core/error.h"
#include "hooke/io/sha256.h"
#include "hooke/io/stl.h"
#include "hooke/io/write_mesh.h"
#include "hooke/mesh/mesh.h"
#include "hooke/mesh/topology.h"
#include "support/crease_solids.h"
#include "support/errors.h"
#include "support/masks.h"
#include "support/meshes.h"
#include "support/solids.h"
#include "support/temporary_folder.h"

namespace hooke::read_mesh_test {

using test::read_text;
using test::TemporaryFolder;
using test::write_text;

// A sphere with every awkward kind of number among its coordinates.
test::Triangles awkward() {
  test::Triangles t = test::sphere(2, .2);
  const double numbers[] = {
      4.9e-324, -1e-320, 1e-300, -0., .1, 1. / 3, 123456789.123456789, 2.2250738585072011e-308};
  Eigen::Index v = 0;
  for (const double x : numbers) t.points(v % 3, v) = x, ++v;
  return t;
}

void expect_same_bits(const TriMesh& mesh, const test::Triangles& t) {
  EXPECT_EQ(triangles_of(mesh), t.faces);
  const auto points = vertex_points(mesh);
  ASSERT_EQ(points.cols(), t.points.cols());
  for (Eigen::Index k = 0; k < points.size(); ++k)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(points.data()[k]),
              std::bit_cast<std::uint64_t>(t.points.data()[k]))
        << k;
}

TEST(ReadMesh, EveryFormatReturnsEveryBitOfTheMesh) {
  const TemporaryFolder folder;
  const test::Triangles t = awkward();
  const TriMesh mesh = test::to_mesh(t);
  for (const auto& [name, encoding] : {std::pair{"a.obj", PlyEncoding::ascii},
                                       {"b.off", PlyEncoding::ascii},
                                       {"c.ply", PlyEncoding::ascii},
                                       {"d.ply", PlyEncoding::binary_little_endian},
                                       {"e.ply", PlyEncoding::binary_big_endian}}) {
    PendingMesh written = prepare_mesh(folder / name, mesh, format_of(name), encoding);
    written.file.commit();
    const LoadedMesh loaded = read_mesh(folder / name);
    expect_same_bits(loaded.mesh, t);
    EXPECT_TRUE(loaded.warnings.empty());
    EXPECT_EQ(loaded.format, format_of(name));
    if (loaded.format == MeshFormat::ply) {
      EXPECT_EQ(loaded.encoding, encoding);
    }
    EXPECT_EQ(loaded.sha256, written.sha256);
    // Once more: the bytes are a fixed point.
    EXPECT_EQ(mesh_bytes(loaded.mesh, loaded.format, encoding), read_text(folder / name));
  }
  EXPECT_EQ(folder.file_count(), 5u);
}

TEST(ReadMesh, LaysTheMeshOut) {
  const TemporaryFolder folder;
  const test::Triangles t = test::shuffled(test::sphere(2));
  prepare_mesh(folder / "m.off", test::to_mesh(t), MeshFormat::off).file.commit();
  const LoadedMesh loaded = read_mesh(folder / "m.off");
  const MemoryOrder expected = find_memory_order(loaded.mesh);
  EXPECT_EQ(loaded.memory_order.order.old_vertex, expected.order.old_vertex);
  EXPECT_EQ(loaded.memory_order.order.old_face, expected.order.old_face);
  EXPECT_EQ(loaded.memory_order.adjacency->faces, expected.adjacency->faces);
  EXPECT_EQ(loaded.memory_order.adjacency->edges, expected.adjacency->edges);
  EXPECT_EQ(loaded.connectivity_sha256, connectivity_sha256(t.faces));
}

TEST(ReadMesh, WarningsNameTheVerticesOfTheFile) {
  const TemporaryFolder folder;
  test::Triangles t = test::shuffled(test::two_parts_and_loose_vertices());
  std::vector<bool> used(t.points.cols());
  for (const Triangle& face : t.faces)
    for (int v : face) used[v] = true;
  std::string loose;
  for (size_t v = 0; v < used.size(); ++v)
    if (!used[v]) loose += (loose.empty() ? "" : ", ") + std::to_string(v);
  prepare_mesh(folder / "m.off", test::to_mesh(t), MeshFormat::off).file.commit();
  const LoadedMesh loaded = read_mesh(folder / "m.off");
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_TRUE(test::has(loaded.warnings[0].message, "vertices " + loose)) << loaded.warnings[0].message;
}

using Codes = std::vector<std::string>;

Codes codes(const auto& told) {
  Codes list;
  for (const auto& one : told) list.push_back(one.code);
  return list;
}

TEST(ReadMesh, GathersTheWarningsOfEachStep) {
  const TemporaryFolder folder;
  write_text(folder / "m.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 9 9 9\nvn 0 0 1\nf 1 2 3 4\n");
  const LoadedMesh loaded = read_mesh(folder / "m.obj");
  EXPECT_EQ(loaded.mesh.n_vertices(), 5u);
  EXPECT_EQ(loaded.mesh.n_faces(), 2u);
  EXPECT_EQ(codes(loaded.content.anew), (Codes{"attributes_not_kept", "polygons_triangulated"}));
  EXPECT_EQ(codes(loaded.content.preserved), Codes{"polygons_triangulated"});
  EXPECT_EQ(codes(loaded.warnings), Codes{"isolated_vertices"});
}

TEST(ReadMesh, WarnsOfTrianglesThatLoseTheValuesOfTheirCorners) {
  const TemporaryFolder folder;
  write_text(folder / "m.obj",
             "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nvt 0 0\nvt 1 0\nvt 1 1\n"
             "f 1/1 2/2 3/3\nf 1/1 3 4\nf 2 5 3\n");
  const LoadedMesh loaded = read_mesh(folder / "m.obj");
  EXPECT_EQ(loaded.corner_data.texture.corners,
            (std::vector<Triangle>{{0, 1, 2}, {-1, -1, -1}, {-1, -1, -1}}));
  ASSERT_EQ(loaded.content.anew.size(), 1u);
  EXPECT_EQ(loaded.content.anew[0].code, "attributes_not_kept");
  EXPECT_TRUE(test::has(loaded.content.anew[0].message,
                        "texture coordinates of triangles of which another corner has none: 1"))
      << loaded.content.anew[0].message;
}

TEST(ReadMesh, ABadMeshIsNamedByTheLinesOfItsPolygons) {
  const TemporaryFolder folder;
  const auto path = folder / "m.obj";
  write_text(path, "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nf 1 2 3 4\nf 1 2 5\n");
  const std::string message = test::message_of<MeshError>([&] { read_mesh(path); });
  EXPECT_TRUE(test::has(message, path.native() + ": ")) << message;
  EXPECT_TRUE(test::has(message, "edges 0-1, faces 0 (line 6), 1 (line 7)")) << message;
}

std::string stl_of(const test::Triangles& t) {
  return write_stl(t.points, t.faces, PlyEncoding::binary_little_endian, {});
}

/// In other formats such a face is one of the mesh, and no triangle.
TEST(ReadMesh, AFacetOfAnStlFileWithTwoCornersInOnePlaceIsDroppedAndTold) {
  const TemporaryFolder folder;
  const test::Triangles t = test::sphere(1);
  test::Triangles with = t;
  const auto alone = static_cast<int>(t.points.cols());  // a vertex of no other facet
  with.points.conservativeResize(3, alone + 1);
  with.points.col(alone) << 0, 0, 5;
  const auto [a, b, c] = t.faces[3];
  with.faces.insert(with.faces.begin() + 1, {{a, b, a}, {alone, alone, alone}, {b, alone, b}});
  write_text(folder / "m.stl", stl_of(with));
  const LoadedMesh loaded = read_mesh(folder / "m.stl");
  EXPECT_EQ(loaded.mesh.n_faces(), t.faces.size());
  EXPECT_EQ(loaded.mesh.n_vertices(), static_cast<size_t>(t.points.cols()));
  EXPECT_EQ(codes(loaded.repairs), (Codes{"faces_dropped", "vertices_dropped"}));
  EXPECT_EQ(loaded.repairs[0].count, 3u);
  EXPECT_TRUE(test::has(loaded.repairs[0].message, "faces 1, 2, 3")) << loaded.repairs[0].message;
  EXPECT_EQ(loaded.origin.face[1], 4);

  std::string obj;
  for (const auto& x : with.points.colwise()) obj += fmt::format("v {} {} {}\n", x[0], x[1], x[2]);
  for (const Triangle& f : with.faces) obj += fmt::format("f {} {} {}\n", f[0] + 1, f[1] + 1, f[2] + 1);
  write_text(folder / "m.obj", obj);
  EXPECT_THROW(read_mesh(folder / "m.obj"), MeshError);
}

/// Marching cubes make such facets where values of an image at grid points are that of the level.
TEST(ReadMesh, AnStlFileOfAnImageOfIntegersIsWithoutItsFacetsInOnePlace) {
  const TemporaryFolder folder;
  const auto whole = [](double value) { return std::round(value) + 1e-12; };
  const test::Triangles t = test::marched_cubes(7, [&](const Vec3& x) { return whole(x.norm() - 5.2); });
  test::Triangles rounded = t;
  rounded.points = (t.points * 1e6).array().round() / 1e6;
  write_text(folder / "m.stl", stl_of(rounded));
  const LoadedMesh loaded = read_mesh(folder / "m.stl");
  ASSERT_EQ(codes(loaded.repairs), (Codes{"faces_dropped"}));
  EXPECT_GT(loaded.repairs[0].count, t.faces.size() / 10);
  EXPECT_EQ(loaded.mesh.n_faces(), t.faces.size() - loaded.repairs[0].count);
  EXPECT_EQ(measure_topology(*loaded.memory_order.adjacency).boundary_edges, 0);
}

/// Two blocks that touch in an edge, or in a corner.
test::Triangles touching_blocks(bool in_an_edge) {
  return test::cells(2, 2, 2, [&](int x, int y, int z) { return x == y && (in_an_edge ? z == 0 : z == x); });
}

/// The vertices of an STL file are only made by its reader, those of an OBJ file stand in it.
TEST(ReadMesh, SolidsThatTouchAreApartInAnStlFileOnly) {
  const TemporaryFolder folder;
  for (const bool in_an_edge : {true, false}) {
    const test::Triangles t = touching_blocks(in_an_edge);
    write_text(folder / "m.stl", stl_of(t));
    const LoadedMesh loaded = read_mesh(folder / "m.stl");
    EXPECT_EQ(codes(loaded.repairs), (Codes{in_an_edge ? "edges_cut" : "vertices_split"}));
    EXPECT_EQ(loaded.repairs[0].count, 1u);
    const Topology topology = measure_topology(*loaded.memory_order.adjacency);
    EXPECT_EQ(topology.components, 2);
    EXPECT_EQ(topology.boundary_edges, 0);
    EXPECT_EQ(topology.euler, 4);
    std::string obj;
    for (const auto& x : t.points.colwise()) obj += fmt::format("v {} {} {}\n", x[0], x[1], x[2]);
    for (const Triangle& f : t.faces) obj += fmt::format("f {} {} {}\n", f[0] + 1, f[1] + 1, f[2] + 1);
    write_text(folder / "m.obj", obj);
    EXPECT_THROW(read_mesh(folder / "m.obj"), MeshError);
    const LoadedMesh joined = read_mesh(folder / "m.stl", nullptr, {{}, {.keep_junctions = true}});
    EXPECT_FALSE(joined.origin.joined.empty());
  }
}

TEST(ReadMesh, SheetsThatMeetInAnStlFileAreNotGuessed) {
  const TemporaryFolder folder;
  const auto message_for = [&](const test::Triangles& t) {
    write_text(folder / "m.stl", stl_of(t));
    return test::message_of<MeshError>([&] { read_mesh(folder / "m.stl"); });
  };
  test::Triangles rib;  // three faces at an edge
  rib.points.resize(3, 5);
  rib.points << 0, 0, 1, -1, 0, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0;
  rib.faces = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  EXPECT_TRUE(test::has(message_for(rib), "--keep non-manifold"));
  const auto turn = [](test::Triangles& t, std::size_t first, std::size_t count) {
    for (std::size_t f = first; f < first + count; ++f) std::swap(t.faces[f][1], t.faces[f][2]);
  };
  test::Triangles one_inside_out = touching_blocks(true);
  const auto is_of_first_block = [&](const Triangle& f) {
    return std::ranges::all_of(f, [&](int v) { return one_inside_out.points(0, v) <= 1; });
  };
  std::partition(one_inside_out.faces.begin(), one_inside_out.faces.end(), is_of_first_block);
  turn(one_inside_out, 0, 12);
  test::Triangles all_inside_out = touching_blocks(true);
  turn(all_inside_out, 0, all_inside_out.faces.size());
  test::Triangles open = touching_blocks(true);
  open.faces.pop_back();
  for (const test::Triangles& t : {one_inside_out, all_inside_out, open})
    EXPECT_TRUE(test::has(message_for(t), "edges with three or more faces (1)")) << message_for(t);
}

TEST(ReadMesh, AnStlFileOfSuchFacetsOnlyIsRefused) {
  const TemporaryFolder folder;
  test::Triangles t = test::sphere(0);
  for (Triangle& f : t.faces) f[1] = f[0];
  write_text(folder / "m.stl", stl_of(t));
  const std::string message = test::message_of<MeshError>([&] { read_mesh(folder / "m.stl"); });
  EXPECT_TRUE(test::has(message, "no faces")) << message;
}

TEST(ReadMesh, ErrorsOfEachKindKeepTheirKind) {
  const TemporaryFolder folder;
  write_text(folder / "points.obj", "v 0 0 0\n");
  write_text(folder / "bad.obj", "v 0 0 x\n");
  EXPECT_THROW(read_mesh(folder / "points.obj"), MeshError);
  EXPECT_THROW(read_mesh(folder / "bad.obj"), InputError);
  EXPECT_THROW(read_mesh(folder / "m.3ds"), InputError);
  EXPECT_THROW(prepare_mesh(folder / "no/m.obj", test::to_mesh(test::sphere(0)), MeshFormat::obj),
               OutputError);
}

TEST(Sha256, AgreesWithTheStandardsExamples) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

}  // namespace hooke::read_mesh_test
