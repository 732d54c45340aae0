// Writes a mesh to a file in any of the formats.
#pragma once

#include <filesystem>
#include <string>

#include "hooke/core/stopwatch.h"
#include "hooke/io/files.h"
#include "hooke/io/mesh_file.h"
#include "hooke/mesh/corner_data.h"
#include "hooke/mesh/mesh.h"

namespace hooke {

/// The name of an output for messages: printable, "standard output" for a standard stream.
std::string name_of_output(const std::filesystem::path& path);

/// What a file holds beside points and triangles.
struct MeshData {
  VertexData vertices = {};
  FaceData faces = {};      // by triangle
  CornerData corners = {};  // of the triangles; takes precedence over texture and normals of the vertices
  std::vector<std::string> material_libraries = {};
  std::string stl_header = {};  // see MeshFile
};

/// The bytes of a mesh file; `encoding` applies to PLY and STL only. Coordinates
/// read back exactly, but for binary STL; vertices and faces keep their order. Of the data, what
/// the format can hold is written (see data_for_format() and face_data_for_format()). Pre-condition: the
/// format is not VTP. Sheets are joined, see mesh/junctions.h.
std::string mesh_bytes(const TriMesh& mesh, MeshFormat format,
                       PlyEncoding encoding = PlyEncoding::binary_little_endian, const MeshData& data = {});

/// A mesh file that is written but not yet committed.
struct PendingMesh {
  PendingFile file;                 // to be committed by the caller
  std::string sha256;               // of its bytes, hexadecimal
  std::string connectivity_sha256;  // see sha256.h
  Mat3X rounded;                    // the points as they stand in the file, if any was rounded; else empty
};

/// Writes mesh_bytes() to a temporary file for `path`, or keeps them for standard output ("-"). Throws what
/// PendingFile and mesh_bytes() throw, those of the latter with the name of the path.
PendingMesh prepare_mesh(const std::filesystem::path& path, const TriMesh& mesh, MeshFormat format,
                         PlyEncoding encoding = PlyEncoding::binary_little_endian, const MeshData& data = {},
                         Stopwatch* stopwatch = nullptr);

}  // namespace hooke
