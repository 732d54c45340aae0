// The content of a mesh file (OBJ, PLY, OFF, STL, Gmsh or VTP) as plain arrays, before validation, and the
// conversion of vertex data between these formats.
#pragma once

#include <string>
#include <string_view>

#include "hooke/core/lists.h"
#include "hooke/io/mesh_format.h"
#include "hooke/mesh/attributes.h"
#include "hooke/mesh/face_data.h"

namespace hooke {

enum class PlyEncoding { ascii, binary_little_endian, binary_big_endian };

/// Warnings about what a file holds besides vertices and triangles. Which of them apply depends on how the
/// output is written.
struct ContentWarnings {
  Warnings anew;       // what is lost when a new file is made
  Warnings no_obj;     // what else is lost when that is no OBJ, the only format with data of corners
  Warnings preserved;  // what goes along unchanged when the file is rewritten, although vertices move
};

/// Values of one kind at the corners of polygons.
struct PolygonCorners {
  Mat3X values;                // one column per value
  int width = 3;               // how many of its numbers count; the others are 0
  std::vector<int> corners{};  // the value of each corner, in the order of the polygons' items; -1 for none.
                               // Empty: no corner has one
};

/// The content of a mesh file. Invariant: points are finite, every polygon has at least three corners, and
/// corners are vertex ids in [0, points.cols()).
struct MeshFile {
  std::string name;  // printable name of the file, for messages
  MeshFormat format = MeshFormat::obj;
  PlyEncoding encoding = PlyEncoding::binary_little_endian;  // of PLY and STL files
  Mat3X points;                                              // vertices in file order
  IntLists polygons{{0}, {}};  // vertex ids (0-based) of each face, in file order
  std::vector<int> lines;      // line number of each polygon; empty for binary files
  VertexData vertex_data;      // other values of the vertices, in file order
  FaceData face_data;          // of the polygons
  PolygonCorners texture;      // texture coordinates, if vertices have several; else they are vertex data
  PolygonCorners normals;      // likewise
  std::vector<std::string> material_libraries;  // the files that an OBJ names for its materials
  std::vector<int> marked_vertices;             // of points that an MSH file has beside its polygons
  std::vector<Edge> marked_edges;               // of its lines
  std::string stl_header;                       // the 80 bytes of a binary STL, where programs put colours
  ContentWarnings content;
  std::string misread;  // what simple readers would read wrongly in the file as it is; empty for nothing
  Warnings warnings;    // others
  Notes notes;          // what was done to the content as it always is, such as welding
};

/// The bytes without a byte order mark at their beginning.
std::string_view without_byte_order_mark(std::string_view bytes);

/// Parses the bytes of a mesh file. `name` is printable and begins all messages. Throws InputError
/// "NAME:LINE: problem; what was expected; what to do" for malformed bytes.
MeshFile parse_mesh_file(std::string_view bytes, const std::string& name, MeshFormat format);

/// Completes the polygon whose corners were appended to file.polygons.items. Throws LimitError for more than
/// 2^31 - 1 corners in all.
void end_polygon(MeshFile& file);

/// Appends the polygons and line numbers of the parts, in order. Throws LimitError beyond 2^31 - 1 corners.
void append_faces(MeshFile& file, const std::vector<MeshFile>& parts);

/// Adds the warning `attributes_not_kept` of a new file that lists the kinds of content ignored by a reader,
/// if any.
void warn_not_kept(MeshFile& file, const std::vector<std::string>& kinds);

/// Adds the warning `carried_along` of a rewritten file that lists the kinds of content besides faces which
/// may refer to vertices, if any.
void warn_carried_along(MeshFile& file, const std::vector<std::string>& kinds);

/// Vertex data converted to a file format.

struct FormatData {
  VertexData data;
  std::vector<std::string> dropped;  // names of channels that the format cannot hold
};

/// Converts vertex data read from the format `from` to the format `to`. PLY holds any channel; OBJ holds
/// colours, normals and texture coordinates if they are finite; OFF holds the same with alpha, but without a
/// third texture coordinate. Colours of integer types range up to the maximum of the type, others up to 1;
/// they become 8-bit integers, but numbers from 0 to 1 in OBJ. The PLY names texture_u and texture_v stand
/// for s and t.
FormatData data_for_format(const VertexData& data, MeshFormat from, MeshFormat to);

/// Face data as a file format holds it.
struct FormatFaceData {
  FaceData data;
  std::vector<std::string> dropped;  // names of channels that the format cannot hold and that differ
};

/// Keeps the channels that the format `to` holds: PLY all, but for their names and, from other formats, those
/// that do not differ; OBJ materials, groups, objects and smoothing groups; MSH groups and entities; STL
/// groups as text, else attributes. Channels of an OBJ that have names count as dropped even if they do not
/// differ.
FormatFaceData face_data_for_format(const FaceData& data, MeshFormat from, MeshFormat to,
                                    PlyEncoding encoding);

}  // namespace hooke
