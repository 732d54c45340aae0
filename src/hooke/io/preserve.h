// Writes the input file again with moved vertices (rewrite.h).
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "hooke/core/stopwatch.h"
#include "hooke/io/write_mesh.h"

namespace hooke {

/// The file that a mesh was read from.
struct SourceFile {
  std::filesystem::path path;
  MeshFormat format;
  std::string sha256;               // of its bytes when they were read
  std::string connectivity_sha256;  // of its triangles, see sha256.h
};

/// A rewritten file, or why there is none.
struct PreservedMesh {
  std::optional<PendingMesh> mesh;  // not yet committed
  std::string obstacle;             // why the file cannot hold the mesh; empty if it can
  Warnings warnings;
};

/// Reads the source again and writes its bytes with the points of the mesh to a temporary file for `path`. A
/// file of single precision is an obstacle if rounding would turn a face over. Throws InputError if the
/// source cannot be read or has changed since, and OutputError. Pre-condition: vertices and faces of the mesh
/// are those of the source, in its order; can_rewrite(source.format).
/// For `texture_follows` see rewrite_mesh().
PreservedMesh prepare_preserved_mesh(const std::filesystem::path& path, const TriMesh& mesh,
                                     const SourceFile& source, bool texture_follows = false,
                                     Stopwatch* stopwatch = nullptr);

}  // namespace hooke
