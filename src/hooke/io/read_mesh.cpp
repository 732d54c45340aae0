#include "hooke/io/read_mesh.h"

#include <iterator>
#include <utility>

#include "hooke/io/file_bytes.h"
#include "hooke/io/polygons.h"
#include "hooke/io/printable.h"
#include "hooke/io/sha256.h"
#include "hooke/validation.h"

namespace hooke {
namespace {

void append(Warnings& warnings, Warnings more) {
  warnings.insert(warnings.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

/// Of a mesh that can be worked on. It is looked at in memory order, where that is quick; what is wrong, or
/// worth a warning, is then told in the order of the file. Pre-condition: all corners are vertices.
Layout valid_layout(const Mat3X& points, const std::vector<Triangle>& triangles, const MeshSource& source,
                    Warnings& warnings, Stopwatch* stopwatch) {
  const auto explain = [&] { append(warnings, require_valid(points, triangles, source)); };
  const int n = static_cast<int>(points.cols());
  Layout layout;
  layout.order = timed(stopwatch, "order", [&] { return reorder(triangles, locality_order(n, triangles)); });
  VertexFans fans;
  timed(stopwatch, "validate", [&] {
    if (!find_problems(layout.order.in_new_order(points), layout.order.faces, &fans).empty()) explain();
  });
  layout.connectivity = timed(stopwatch, "connectivity", [&] {
    return std::make_shared<const Connectivity>(
        make_connectivity(std::exchange(layout.order.faces, {}), std::move(fans)));
  });
  return layout;
}

}  // namespace

LoadedMesh read_mesh(const std::filesystem::path& path, Stopwatch* stopwatch) {
  const std::string format = input_format_of(path);
  std::string bytes = timed(stopwatch, "file", [&] { return read_regular_file(path); });
  MeshFile file =
      timed(stopwatch, "parse", [&] { return parse_mesh_file(bytes, printable(path.native()), format); });
  const std::string hash = timed(stopwatch, "sha256", [&] { return sha256(bytes); });
  bytes = {};  // the memory is wanted for the mesh
  Triangulation triangulation =
      timed(stopwatch, "triangulate", [&] { return triangulate(file.points, file.polygons); });
  Warnings warnings = std::move(file.warnings);
  append(warnings, warnings_of(triangulation, file.name));
  const MeshSource source{file.name, std::move(triangulation.polygon), std::move(file.lines)};
  Layout layout = valid_layout(file.points, triangulation.triangles, source, warnings, stopwatch);
  require_workable_size(file.points, file.name);
  const std::string faces_hash =
      timed(stopwatch, "sha256", [&] { return connectivity_sha256(triangulation.triangles); });
  triangulation = {};
  // Built in place: OpenMesh has no move, and copies all of a mesh.
  return {timed(stopwatch, "build",
                [&] { return build_mesh(file.points, *layout.connectivity, layout.order.old_ids()); }),
          std::move(layout),
          file.format,
          file.encoding,
          hash,
          faces_hash,
          std::move(file.vertex_data),
          std::move(warnings)};
}

}  // namespace hooke
