#include "hooke/io/read_mesh.h"

#include <utility>

#include "hooke/core/parallel.h"
#include "hooke/core/printable.h"
#include "hooke/io/files.h"
#include "hooke/io/polygon_triangulation.h"
#include "hooke/io/sha256.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/validation.h"

namespace hooke {
namespace {

/// The memory order and adjacency of a mesh, after validation. The mesh is checked in memory order, which is
/// faster; errors and warnings are then generated in file order.
MemoryOrder valid_layout(const Mat3X& points, const std::vector<Triangle>& triangles, Permutation order,
                         const MeshSource& source, Warnings& warnings, Stopwatch* stopwatch) {
  const auto explain = [&] { append(warnings, require_valid(points, triangles, source)); };
  MemoryOrder memory_order{std::move(order), nullptr};
  VertexFans fans;
  timed(stopwatch, "validate", [&] {
    if (!find_problems(memory_order.order.gather(points), memory_order.order.faces, &fans).empty()) explain();
  });
  memory_order.adjacency = timed(stopwatch, "connectivity", [&] {
    return std::make_shared<const Adjacency>(
        make_adjacency(std::exchange(memory_order.order.faces, {}), std::move(fans)));
  });
  return memory_order;
}

}  // namespace

LoadedMesh read_mesh(const std::filesystem::path& path, Stopwatch* stopwatch) {
  const std::string format = input_format_of(path);
  FileBytes content = timed(stopwatch, "file", [&] { return read_regular_file(path); });
  MeshFile file = timed(stopwatch, "parse",
                        [&] { return parse_mesh_file(content.text(), printable(path.native()), format); });
  TriangulatedPolygons triangulation =
      timed(stopwatch, "triangulate", [&] { return triangulate(file.points, file.polygons); });
  Warnings warnings = std::move(file.warnings);
  ContentWarnings content_warnings = std::move(file.content);
  append_warnings(triangulation, file.name, content_warnings, warnings);
  if (misread_as_fans(file.points, file.polygons, triangulation))
    file.misread = "concave polygons, which overlap when they are cut as fans";
  const std::vector<Triangle>& triangles = triangulation.triangles;

  Permutation order;
  std::string hash, faces_hash;
  const auto find_order = [&] {
    order = reorder(triangles, bfs_cluster_order(static_cast<int>(file.points.cols()), triangles));
  };
  const auto take_hashes = [&] {
    hash = sha256(content.text());
    faces_hash = connectivity_sha256(triangles);
  };
  timed(stopwatch, "order", [&] { parallel_invoke(find_order, take_hashes); });
  content = {};  // frees memory for the mesh

  const MeshSource source{file.name, std::move(triangulation.polygon), std::move(file.lines)};
  MemoryOrder memory_order =
      valid_layout(file.points, triangles, std::move(order), source, warnings, stopwatch);
  require_workable_size(file.points, file.name);
  triangulation = {};
  // Constructed in place, because OpenMesh meshes can only be copied, not moved.
  return {
      timed(stopwatch, "build",
            [&] { return build_mesh(file.points, *memory_order.adjacency, memory_order.order.old_ids()); }),
      std::move(memory_order),
      file.format,
      file.encoding,
      std::move(hash),
      std::move(faces_hash),
      std::move(file.vertex_data),
      std::move(content_warnings),
      std::move(file.misread),
      std::move(warnings)};
}

}  // namespace hooke
