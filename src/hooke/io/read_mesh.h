// Reads a mesh file into a validated triangle mesh.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "hooke/core/lists.h"
#include "hooke/core/stopwatch.h"
#include "hooke/io/mesh_file.h"
#include "hooke/mesh/corner_data.h"
#include "hooke/mesh/mesh.h"
#include "hooke/mesh/repair.h"

namespace hooke {

/// A mesh with the data of its file that the report and the writer need. Ids in files are those before a
/// repair.
struct LoadedMesh {
  TriMesh mesh;              // vertices and faces in file order; triangles of a polygon are consecutive
  MemoryOrder memory_order;  // memory order of the mesh, with its adjacency
  MeshFormat format = MeshFormat::obj;
  PlyEncoding encoding = PlyEncoding::binary_little_endian;  // of PLY and STL files
  std::string sha256;                                        // of the bytes of the file, hexadecimal
  std::string connectivity_sha256;                           // see sha256.h
  IntLists polygons;                                         // of the file; empty if all are triangles
  VertexData vertex_data;                                    // values of the vertices in the file
  FaceData face_data;                                        // of the triangles
  CornerData corner_data;                                    // of the triangles, where not of the vertices
  std::vector<std::string> material_libraries;               // see MeshFile
  std::vector<int> marked_vertices;                          // see MeshFile; empty if it was repaired
  std::vector<Edge> marked_edges;                            // likewise
  std::string stl_header;                                    // see MeshFile
  MeshOrigin origin;                                         // if the mesh was repaired
  Notes notes;                                               // see MeshFile
  Notes repairs;                                             // what the repair did
  ContentWarnings content;                                   // about what else is in the file
  std::string misread;                                       // see MeshFile
  Warnings warnings;  // others, from reading, triangulation and validation, in this order
};

struct ReadOptions {
  std::optional<MeshFormat> format;  // of the file; none: by its extension
  RepairOptions repair;
};

/// The name of an input for messages: printable, "standard input" for a standard stream.
std::string name_of_input(const std::filesystem::path& path);

/// Reads a mesh file, or standard input for "-", triangulates its polygons, repairs the mesh if asked to,
/// validates and builds it. Facets of an STL file with two corners in one place are dropped, and closed
/// solids that only touch get vertices of their own. Throws InputError if the file is not a well-formed mesh
/// file, MeshError if the mesh is not an oriented manifold with area, and LimitError if it does not fit in
/// memory.
LoadedMesh read_mesh(const std::filesystem::path& path, Stopwatch* stopwatch = nullptr,
                     const ReadOptions& options = {});

}  // namespace hooke
