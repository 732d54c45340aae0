// Reads a mesh file into a validated triangle mesh.
#pragma once

#include <filesystem>
#include <string>

#include "hooke/core/stopwatch.h"
#include "hooke/io/mesh_file.h"
#include "hooke/mesh/mesh.h"

namespace hooke {

/// A mesh with the data of its file that the report and the writer need.
struct LoadedMesh {
  TriMesh mesh;              // vertices and faces in file order; triangles of a polygon are consecutive
  MemoryOrder memory_order;  // memory order of the mesh, with its adjacency
  std::string format;        // "obj", "ply" or "off"
  PlyEncoding encoding = PlyEncoding::binary_little_endian;  // of a PLY file
  std::string sha256;                                        // of the bytes of the file, hexadecimal
  std::string connectivity_sha256;                           // see sha256.h
  VertexData vertex_data;                                    // values of the vertices in the file
  ContentWarnings content;                                   // about what else is in the file
  std::string misread;                                       // see MeshFile
  Warnings warnings;  // others, from reading, triangulation and validation, in this order
};

/// Reads a mesh file, triangulates its polygons, validates and builds the mesh. Throws InputError if the file
/// is not a well-formed mesh file, MeshError if the mesh is not an oriented manifold with area, and
/// LimitError if it does not fit in memory.
LoadedMesh read_mesh(const std::filesystem::path& path, Stopwatch* stopwatch = nullptr);

}  // namespace hooke
