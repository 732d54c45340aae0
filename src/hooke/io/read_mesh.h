// From a file to a mesh that can be worked on.
#pragma once

#include <filesystem>
#include <string>

#include "hooke/core/stopwatch.h"
#include "hooke/io/mesh_file.h"
#include "hooke/mesh/mesh.h"

namespace hooke {

/// A mesh, and what the report and the writer want to know about its file.
struct LoadedMesh {
  TriMesh mesh;              // vertices in file order; triangles too, those of a polygon together
  MemoryOrder memory_order;  // of the mesh
  std::string format;        // "obj", "ply" or "off"
  PlyEncoding encoding = PlyEncoding::binary_little_endian;  // of a ply file
  std::string sha256;                                        // of the file's bytes, hex
  std::string connectivity_sha256;                           // see sha256.h
  VertexData vertex_data;                                    // of the file
  Warnings warnings;  // of reading, triangulation and validation, in this order
};

/// Reads, triangulates, validates and builds. Throws InputError for what is not a well-formed mesh file,
/// MeshError for what is not an oriented manifold with area, LimitError for what does not fit in memory.
LoadedMesh read_mesh(const std::filesystem::path& path, Stopwatch* stopwatch = nullptr);

}  // namespace hooke
