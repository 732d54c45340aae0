// What a file tells of the corners of faces, such as texture coordinates, as data of vertices.
#pragma once

#include <string>

#include "hooke/io/mesh_file.h"
#include "hooke/io/scanner.h"

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

// Vertices, texture coordinates and normals of an OBJ file, to which its faces refer by number.

/// The elements of one kind, as far as a piece of the text has been read.
struct ObjElements {
  const char* kind;
  Mat3X& values;      // of the whole text, one column per element
  int count = 0;      // from the beginning of the text
  int greatest = -1;  // 0-based index that a face of the piece asked for
  int max_line = 0;
  // Of texture coordinates and normals, without which we can do:
  int min_numbers = 3;
  int numbers = 0;                // most that an element of the piece has
  int broken_line = 0;            // the first whose numbers cannot be used
  std::vector<int> of_corners{};  // their ids, as far as corners of the piece have one; -1 for none
};

/// Throws InputError beyond 2^31 - 1.
void count_one(const Scanner& in, ObjElements& elements);

/// The rest of the line of a texture coordinate or a normal. Broken numbers are noted: they are common, such
/// as the "nan" of faces without area.
void read_numbers(Scanner& in, ObjElements& elements);

/// 0-based id of `text`, the index of one of the elements in the face corner `corner`. Throws InputError
/// unless it is an integer that can point to one.
int read_index(const Scanner& in, std::string_view text, std::string_view corner, ObjElements& elements);

/// The same for a texture coordinate or a normal, which becomes that of the piece's corner of this number.
void read_corner_index(const Scanner& in, std::string_view text, std::string_view corner, size_t number,
                       ObjElements& elements);

/// The same kind of elements from all pieces of the text, in order.
using ObjElementPieces = std::vector<const ObjElements*>;

/// Positive indices may point forward, so their upper bound is known only at the end. Throws InputError.
void check_greatest(const std::string& name, const ObjElementPieces& pieces);

/// Makes texture coordinates or normals vertex data of the file, or says why they are not kept: in `not_kept`
/// or in a warning of the file. Pre-condition: in every piece of_corners has all corners, unless the whole
/// text has no elements.
void keep_elements(const ObjElementPieces& pieces, const CornerDataKind& kind, MeshFile& file,
                   std::vector<std::string>& not_kept);

}  // namespace hooke
