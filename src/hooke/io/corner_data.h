// What a file tells of the corners of faces, such as texture coordinates, as data of vertices.
#pragma once

#include <string>

#include "hooke/io/mesh_file.h"

namespace hooke {

/// Elements of one kind, each of up to three numbers, to which the corners of polygons refer.
struct CornerData {
  const Mat3X& values;        // one column per element
  std::vector<int> elements;  // of each corner, in the order of the polygons' items; -1 for none
};

/// Where the corners of a vertex have different values.
struct Seams {
  std::vector<int> vertices;  // ids, ascending
  size_t edges = 0;           // along which the values of two faces differ
};

/// Element of each vertex, that of its first corner; -1 for a vertex without corners.
std::vector<int> elements_of_vertices(const CornerData& data, const IntLists& polygons, int vertex_count);

/// `of_vertices`: from elements_of_vertices(). Pre-condition: every corner has an element.
Seams find_seams(const CornerData& data, const IntLists& polygons, const std::vector<int>& of_vertices);

/// How channels and messages name a kind of corner data.
struct CornerDataKind {
  ChannelNames channels;  // of its numbers
  NumberType type;        // of the channels
  const char* what;       // "texture coordinates"
  const char* element;    // "vt"
  const char* seams;      // what edges are along which they differ: "seams"
  const char* code;       // of the warning that names those
};

/// Adds the data to file.vertex_data where each vertex has the same values in all its corners, 0 where it has
/// none. Else adds the warning that names the seams. `width`: how many numbers an element has.
/// Pre-condition: every corner has an element.
void keep_as_vertex_data(MeshFile& file, const CornerData& data, size_t width, const CornerDataKind& kind);

}  // namespace hooke
