#include "hooke/io/preserve.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "hooke/core/error.h"
#include "hooke/core/parallel.h"
#include "hooke/core/printable.h"
#include "hooke/io/files.h"
#include "hooke/io/rewrite.h"
#include "hooke/io/sha256.h"

namespace hooke {
namespace {

FileBytes read_unchanged(const SourceFile& source) {
  FileBytes file = read_regular_file(source.path);
  if (sha256(file.text()) != source.sha256)
    throw InputError(
        printable(source.path.native()) +
        ": has changed since it was read; expected the same bytes, to write them with moved vertices; run "
        "again, or use --preserve off");
  return file;
}

// The number of faces that turn over, or lose their area, when the points are rounded.
std::ptrdiff_t faces_turned_by_rounding(const TriMesh& mesh, const Mat3X& rounded) {
  const auto normal = [](const auto& points, const Triangle& t) -> Vec3 {
    const Vec3 a = points.col(t[0]), ab = points.col(t[1]) - a, ac = points.col(t[2]) - a;
    return ab.cross(ac);
  };
  const auto exact = vertex_points(mesh);
  return std::ranges::count_if(triangles_of(mesh), [&](const Triangle& t) {
    const Vec3 n = normal(exact, t);
    return !n.isZero(0) && !(n.dot(normal(rounded, t)) > 0);
  });
}

}  // namespace

PreservedMesh prepare_preserved_mesh(const std::filesystem::path& path, const TriMesh& mesh,
                                     const SourceFile& source, const std::vector<MapEntry>* map,
                                     Stopwatch* stopwatch) {
  RewrittenMesh rewritten;
  {
    const FileBytes file = timed(stopwatch, "read again", [&] { return read_unchanged(source); });
    rewritten = timed(stopwatch, "rewrite", [&] {
      return rewrite_mesh(file.text(), printable(source.path.native()), source.format, vertex_points(mesh),
                          map);
    });
  }
  PreservedMesh result{{}, std::move(rewritten.obstacle), std::move(rewritten.warnings)};
  if (result.obstacle.empty() && rewritten.rounded.size() > 0)
    if (const auto turned = faces_turned_by_rounding(mesh, rewritten.rounded); turned > 0)
      result.obstacle =
          fmt::format("its coordinates have single precision, which would turn {} faces over", turned);
  if (!result.obstacle.empty()) return result;
  const Stage stage(stopwatch, "file");
  std::optional<PendingFile> file;
  std::string hash;
  parallel_invoke(
      [&] {
        file.emplace(is_standard_output(path) ? PendingFile::to_standard_output(rewritten.bytes)
                                              : PendingFile(path, rewritten.bytes));
      },
      [&] { hash = sha256(rewritten.bytes); });
  result.mesh.emplace(PendingMesh{*std::move(file), std::move(hash), source.connectivity_sha256});
  return result;
}

}  // namespace hooke
