// From a mesh to a file.
#pragma once

#include <filesystem>
#include <string>

#include "hooke/io/mesh_file.h"
#include "hooke/mesh.h"
#include "hooke/stopwatch.h"

namespace hooke {

/// The bytes of the mesh in a format ("obj", "ply" or "off"); `encoding` is of a ply file. Coordinates read
/// back as exactly the same; vertices and faces keep their order. Of the data the format's part is written:
/// see format_data.h. Throws Error for another format.
std::string mesh_bytes(const TriMesh& mesh, const std::string& format,
                       PlyEncoding encoding = PlyEncoding::binary_little_endian, const VertexData& data = {});

struct WrittenFile {
  std::string sha256;  // of its bytes, hex
  size_t bytes = 0;
};

/// Writes these bytes by write_file_atomically (see there for what it throws). The usual format is
/// format_of(path).
WrittenFile write_mesh(const std::filesystem::path& path, const TriMesh& mesh, const std::string& format,
                       PlyEncoding encoding = PlyEncoding::binary_little_endian, const VertexData& data = {},
                       Stopwatch* stopwatch = nullptr);

}  // namespace hooke
