#include "hooke/io/rewrite.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "hooke/core/error.h"
#include "hooke/core/parallel.h"
#include "hooke/core/printable.h"
#include "hooke/geometry/triangle.h"
#include "hooke/io/files.h"
#include "hooke/io/mesh_file.h"
#include "hooke/io/rewrite_formats.h"
#include "hooke/io/sha256.h"
#include "hooke/mesh/junctions.h"

namespace hooke {

bool can_rewrite(MeshFormat format) {
  return format != MeshFormat::stl && format != MeshFormat::vtp;
}

RewrittenMesh rewrite_mesh(std::string_view bytes, const std::string& name, MeshFormat format,
                           const Mat3X& points, bool texture_follows) {
  const std::string_view content = without_byte_order_mark(bytes);
  const auto rewrite = [&] {
    switch (format) {
      case MeshFormat::obj:
        return rewrite_obj(content, name, points, texture_follows);
      case MeshFormat::ply:
        return rewrite_ply(content, name, points);
      case MeshFormat::off:
        return rewrite_off(content, name, points);
      case MeshFormat::msh:
      case MeshFormat::msh2:
        return rewrite_msh(content, name, points);
      case MeshFormat::stl:
      case MeshFormat::vtp:
        break;
    }
    throw std::logic_error("a format that is not rewritten");
  };
  RewrittenMesh result = rewrite();
  result.bytes.insert(0, bytes.substr(0, bytes.size() - content.size()));
  return result;
}

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

}  // namespace

PreservedMesh prepare_preserved_mesh(const std::filesystem::path& path, const TriMesh& mesh,
                                     const SourceFile& source, bool texture_follows, Stopwatch* stopwatch) {
  RewrittenMesh rewritten;
  const std::optional<JoinedMesh> joined = join_sheets(mesh);
  const Mat3X joined_points = joined ? joined->gather(vertex_points(mesh)) : Mat3X();
  {
    const FileBytes file = timed(stopwatch, "read again", [&] { return read_unchanged(source); });
    rewritten = timed(stopwatch, "rewrite", [&] {
      const std::string name = printable(source.path.native());
      return joined ? rewrite_mesh(file.text(), name, source.format, joined_points, texture_follows)
                    : rewrite_mesh(file.text(), name, source.format, vertex_points(mesh), texture_follows);
    });
  }
  if (joined && rewritten.rounded.size() > 0) rewritten.rounded = joined->scatter(rewritten.rounded);
  PreservedMesh result{{}, std::move(rewritten.obstacle), std::move(rewritten.warnings)};
  if (result.obstacle.empty() && rewritten.rounded.size() > 0)
    if (const auto turned = count_turned_faces(vertex_points(mesh), rewritten.rounded, triangles_of(mesh));
        turned > 0)
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
  result.mesh.emplace(PendingMesh{*std::move(file), std::move(hash), source.connectivity_sha256,
                                  std::move(rewritten.rounded)});
  return result;
}

}  // namespace hooke
