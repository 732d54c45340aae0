#include "hooke/io/write_mesh.h"

#include <fmt/format.h>

#include "hooke/error.h"
#include "hooke/io/obj.h"
#include "hooke/io/off.h"
#include "hooke/io/ply.h"
#include "hooke/io/printable.h"
#include "hooke/io/sha256.h"

namespace hooke {

namespace {

std::string bytes_of(const TriMesh& mesh, const std::vector<Triangle>& triangles, const std::string& format,
                     PlyEncoding encoding, const VertexData& data) {
  const auto points = positions(mesh);
  if (format == "obj") return write_obj(points, triangles, data);
  if (format == "ply") return write_ply(points, triangles, encoding, data);
  if (format == "off") return write_off(points, triangles, data);
  throw Error(fmt::format("format {}; expected obj, ply or off; choose one of them", in_quotes(format)));
}

}  // namespace

std::string mesh_bytes(const TriMesh& mesh, const std::string& format, PlyEncoding encoding,
                       const VertexData& data) {
  return bytes_of(mesh, triangles_of(mesh), format, encoding, data);
}

PendingMesh prepare_mesh(const std::filesystem::path& path, const TriMesh& mesh, const std::string& format,
                         PlyEncoding encoding, const VertexData& data, Stopwatch* stopwatch) {
  std::vector<Triangle> triangles;
  const std::string bytes = timed(stopwatch, "format", [&] {
    triangles = triangles_of(mesh);
    return bytes_of(mesh, triangles, format, encoding, data);
  });
  PendingFile file = timed(stopwatch, "file", [&] { return PendingFile(path, bytes); });
  const Stage stage(stopwatch, "sha256");
  return {std::move(file), sha256(bytes), connectivity_sha256(triangles)};
}

}  // namespace hooke
