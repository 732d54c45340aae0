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

LoadedMesh read_mesh(const std::filesystem::path& path) {
  const std::string format = input_format_of(path);
  LoadedMesh loaded;
  MeshFile file;
  {
    const std::string bytes = read_regular_file(path);
    loaded.sha256 = sha256(bytes);
    loaded.bytes = bytes.size();
    file = parse_mesh_file(bytes, printable(path.native()), format);
  }
  Triangulation triangulation = triangulate(file.points, file.polygons);
  loaded.name = file.name;
  loaded.format = file.format;
  loaded.encoding = file.encoding;
  loaded.polygons_cut = triangulation.polygons_cut;
  loaded.warnings = std::move(file.warnings);
  append(loaded.warnings, warnings_of(triangulation, file.name));
  const MeshSource source{file.name, std::move(triangulation.polygon), std::move(file.lines)};
  append(loaded.warnings, require_valid(file.points, triangulation.triangles, source));
  loaded.mesh = build_mesh(file.points, triangulation.triangles);
  return loaded;
}

}  // namespace hooke
