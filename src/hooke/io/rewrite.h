// A mesh file written again after its vertices were moved: the same bytes, but for the digits of coordinates
// that differ and of the normals that change with them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "hooke/core/stopwatch.h"
#include "hooke/core/types.h"
#include "hooke/io/mesh_format.h"
#include "hooke/io/write_mesh.h"

namespace hooke {

/// A mesh file with other coordinates.
struct RewrittenMesh {
  std::string bytes;
  std::string obstacle;  // why the file cannot hold the points; empty if it can
  Mat3X rounded;         // the points as they stand in the bytes, if any was rounded to float; else empty
  Warnings warnings;
};

/// The obstacle of a number type that is too small.
inline constexpr char out_of_range[] = "its coordinates are of a type that cannot hold the result";

/// Whether rewrite_mesh() knows the format.
bool can_rewrite(MeshFormat format);

/// The file with its vertices at `points` (3 x |V|, in file order). Everything else stays byte for byte, also
/// the text of numbers that are equal to the new ones: comments, line ends, faces of any size, data of any
/// kind. New coordinates are written with the digits that read back exactly, in the type of the file: single
/// precision rounds, and an integer that would need a fraction is an obstacle, as is a float out of range.
/// Normals of vertices, of face corners (OBJ) and of faces (PLY) are renewed where a vertex of their faces
/// moved (see renewed_normals.h); the warning `normals_shared` counts those that no longer suit all of their
/// corners. Texture coordinates stay, unless it is OBJ and `texture_follows` (see reprojected_texture.h); the
/// warning `texture_shared` counts those that cannot. Pre-condition: parse_mesh_file() accepts the bytes and
/// finds as many vertices; can_rewrite(format); where `texture_follows`, require_valid() accepts the mesh.
RewrittenMesh rewrite_mesh(std::string_view bytes, const std::string& name, MeshFormat format,
                           const Mat3X& points, bool texture_follows = false);

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
