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
  VertexFans fans;
  append(warnings, timed(stopwatch, "validate",
                         [&] { return require_valid(file.points, triangulation.triangles, source, &fans); }));
  require_workable_size(file.points, file.name);
  Connectivity connectivity = timed(stopwatch, "connectivity", [&] {
    return make_connectivity(std::move(triangulation.triangles), std::move(fans));
  });
  // Built in place: OpenMesh has no move, and copies all of a mesh.
  return {timed(stopwatch, "build", [&] { return build_mesh(file.points, connectivity); }),
          std::move(connectivity),
          file.format,
          file.encoding,
          hash,
          std::move(file.vertex_data),
          std::move(warnings)};
}

}  // namespace hooke
