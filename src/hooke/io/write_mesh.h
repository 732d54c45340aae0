// From a mesh to a file.
#pragma once

#include <filesystem>
#include <string>

#include "hooke/core/stopwatch.h"
#include "hooke/io/files.h"
#include "hooke/io/mesh_file.h"
#include "hooke/mesh/mesh.h"

namespace hooke {

/// The bytes of the mesh in a format ("obj", "ply" or "off"); `encoding` is of a ply file. Coordinates read
/// back as exactly the same; vertices and faces keep their order. Of the data the format's part is written:
/// see format_data.h. Throws Error for another format.
std::string mesh_bytes(const TriMesh& mesh, const std::string& format,
                       PlyEncoding encoding = PlyEncoding::binary_little_endian, const VertexData& data = {});

struct PendingMesh {
  PendingFile file;                 // to be committed
  std::string sha256;               // of its bytes, hex
  std::string connectivity_sha256;  // see sha256.h
};

/// Writes these bytes beside their place, which is `path` (see atomic_write.h for what it throws). The usual
/// format is format_of(path).
PendingMesh prepare_mesh(const std::filesystem::path& path, const TriMesh& mesh, const std::string& format,
                         PlyEncoding encoding = PlyEncoding::binary_little_endian,
                         const VertexData& data = {}, Stopwatch* stopwatch = nullptr);

}  // namespace hooke
