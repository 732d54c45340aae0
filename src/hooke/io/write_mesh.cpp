#include "hooke/io/write_mesh.h"

#include <fmt/format.h>

#include <cassert>
#include <optional>
#include <utility>

#include "hooke/core/error.h"
#include "hooke/core/parallel.h"
#include "hooke/core/printable.h"
#include "hooke/io/msh.h"
#include "hooke/io/obj.h"
#include "hooke/io/off.h"
#include "hooke/io/ply.h"
#include "hooke/io/sha256.h"
#include "hooke/io/stl.h"
#include "hooke/mesh/junctions.h"

namespace hooke {

namespace {

std::string bytes_of(const Eigen::Ref<const Mat3X>& points, const std::vector<Triangle>& triangles,
                     MeshFormat format, PlyEncoding encoding, const MeshData& data) {
  switch (format) {
    case MeshFormat::obj:
      return write_obj(points, triangles,
                       ObjData{data.vertices, data.faces, data.corners, data.material_libraries});
    case MeshFormat::ply:
      return write_ply(points, triangles, encoding, data.vertices, ply_face_data(data.faces));
    case MeshFormat::off:
      return write_off(points, triangles, data.vertices);
    case MeshFormat::stl:
      return write_stl(points, triangles, encoding, data.faces, data.stl_header);
    case MeshFormat::msh:
    case MeshFormat::msh2:
      return write_msh(points, triangles, format, data.faces);
    case MeshFormat::vtp:
      break;
  }
  assert(false && "VTP is not written");
  return "";
}

std::string joined_bytes(const TriMesh& mesh, const JoinedMesh& joined, MeshFormat format,
                         PlyEncoding encoding, MeshData data) {
  data.vertices = joined.gather(data.vertices);
  return bytes_of(joined.gather(vertex_points(mesh)), joined.triangles, format, encoding, data);
}

}  // namespace

std::string name_of_output(const std::filesystem::path& path) {
  return is_standard_output(path) ? "standard output" : printable(path.native());
}

std::string mesh_bytes(const TriMesh& mesh, MeshFormat format, PlyEncoding encoding, const MeshData& data) {
  if (const auto joined = join_sheets(mesh)) return joined_bytes(mesh, *joined, format, encoding, data);
  return bytes_of(vertex_points(mesh), triangles_of(mesh), format, encoding, data);
}

PendingMesh prepare_mesh(const std::filesystem::path& path, const TriMesh& mesh, MeshFormat format,
                         PlyEncoding encoding, const MeshData& data, Stopwatch* stopwatch) {
  std::vector<Triangle> triangles;
  std::string bytes = timed(stopwatch, "format", [&] {
    const std::optional<JoinedMesh> joined = join_sheets(mesh);
    triangles = joined ? joined->triangles : triangles_of(mesh);
    try {
      if (joined) return joined_bytes(mesh, *joined, format, encoding, data);
      return bytes_of(vertex_points(mesh), triangles, format, encoding, data);
    } catch (const OutputError& e) {
      throw OutputError(fmt::format("{}: {}", name_of_output(path), e.what()));
    }
  });
  Mat3X rounded;
  if (format == MeshFormat::stl && encoding != PlyEncoding::ascii)
    rounded = rounded_to_floats(vertex_points(mesh));
  const Stage stage(stopwatch, "file");
  std::optional<PendingFile> file;
  std::string hash, faces_hash;
  const auto take_hashes = [&] {
    hash = sha256(bytes);
    faces_hash = connectivity_sha256(triangles);
  };
  if (is_standard_output(path)) {
    take_hashes();
    return {PendingFile::to_standard_output(std::move(bytes)), std::move(hash), std::move(faces_hash),
            std::move(rounded)};
  }
  parallel_invoke([&] { file.emplace(path, bytes); }, take_hashes);
  return {*std::move(file), std::move(hash), std::move(faces_hash), std::move(rounded)};
}

}  // namespace hooke
