// What a mesh file holds, in plain arrays, before anybody asks whether it is a good mesh.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "hooke/mesh/attributes.h"

namespace hooke {

enum class PlyEncoding { ascii, binary_little_endian, binary_big_endian };

/// Invariant: points are finite, every polygon has at least three corners, corners are ids in [0,
/// points.cols()).
struct MeshFile {
  std::string name;                                          // of the file, printable, for messages
  std::string format;                                        // "obj", "ply" or "off"
  PlyEncoding encoding = PlyEncoding::binary_little_endian;  // of a ply file
  Mat3X points;                                              // in file order
  IntLists polygons{{0}, {}};  // corner ids (0-based) of each face, in file order
  std::vector<int> lines;      // line of each polygon in the file; empty for binary files
  VertexData vertex_data;      // what the format tells of vertices besides, in file order
  Warnings warnings;
};

/// "obj", "ply" or "off", from the path's extension in any case. Throws Error if it is none of them.
std::string format_of(const std::filesystem::path& path);

/// The same, but InputError: for a file that is to be read.
std::string input_format_of(const std::filesystem::path& path);

/// Reads the mesh file that the bytes are; `format` as from format_of, `name` is printable and begins the
/// messages. Throws InputError "NAME:LINE: what; what was expected; what to do" on anything that is not as
/// the format wants it.
MeshFile parse_mesh_file(std::string_view bytes, const std::string& name, const std::string& format);

/// Ends the polygon whose corners were appended to file.polygons.items. Throws LimitError beyond 2^31 - 1
/// corners.
void end_polygon(MeshFile& file);

/// Appends the polygons and lines of the parts, in order. Throws LimitError beyond 2^31 - 1 corners.
void append_faces(MeshFile& file, const std::vector<MeshFile>& parts);

/// Adds the warning `attributes_not_kept` that names the kinds of content a reader passed over; none if none.
void warn_not_kept(MeshFile& file, const std::vector<std::string>& kinds);

// What of the data of vertices a file format can hold.

struct FormatData {
  VertexData data;
  std::vector<std::string> left_out;  // names of channels
};

/// Data that was read from one format, as another holds it: PLY any; OBJ colours, normals and texture
/// coordinates if finite; OFF these with an alpha, but no third texture coordinate. Colours of integer types
/// count up to the type's greatest value, others to 1; they become 8-bit ones, but in OBJ numbers from 0
/// to 1. The names texture_u and texture_v of PLY mean s and t.
FormatData data_for_format(const VertexData& data, const std::string& from, const std::string& to);

}  // namespace hooke
