// Data of face corners, such as the texture coordinates and normals of an OBJ file, read by index and
// converted to vertex data where it is unique per vertex.
#pragma once

#include <string>

#include "hooke/io/mesh_file.h"
#include "hooke/io/scanner.h"

namespace hooke {

/// Corner data of one kind: elements of up to three numbers each, and the element of every polygon corner.
struct ElementsOfCorners {
  const Mat3X& values;        // one column per element
  std::vector<int> elements;  // per corner, in the order of the polygons' items; -1 for none
};

/// The vertices and edges across which corner data is discontinuous.
struct CornerSeams {
  std::vector<int> vertices;  // with different values at their corners; ids, ascending
  size_t edges = 0;           // number of edges along which the values of two faces differ
};

/// The element of each vertex, taken from its first corner; -1 for a vertex without corners.
std::vector<int> elements_of_vertices(const ElementsOfCorners& data, const IntLists& polygons,
                                      int vertex_count);

/// Finds the discontinuities of corner data. `of_vertices` is the result of elements_of_vertices().
/// Pre-condition: every corner has an element.
CornerSeams find_corner_seams(const ElementsOfCorners& data, const IntLists& polygons,
                              const std::vector<int>& of_vertices);

/// The names of a kind of corner data in vertex channels and messages.
struct CornerDataKind {
  ChannelNames channels;  // one per number of an element
  NumberType type;        // of the channels
  const char* what;       // plural name: "texture coordinates"
  const char* element;    // keyword: "vt"
  const char* seams;      // name of edges along which the values differ: "seams"
  const char* code;       // code of the warning that lists these edges
};

/// Adds the data to file.vertex_data if each vertex has the same values at all its corners; vertices without
/// corners get 0. Otherwise returns the warning that lists the seams, for formats without data of corners.
/// `width` is the number of values per element. Pre-condition: every corner has an element.
Warnings keep_as_vertex_data(MeshFile& file, const ElementsOfCorners& data, size_t width,
                             const CornerDataKind& kind);

/// The elements of one kind in an OBJ file (vertices, texture coordinates or normals), as read so far from a
/// piece of its text.
struct ObjElements {
  const char* kind;
  Mat3X& values;       // of all elements in the text, one per column
  int count = 0;       // number of elements from the beginning of the text
  int max_index = -1;  // largest index (0-based) that a face of the piece refers to
  int max_line = 0;    // line of that face
  // For texture coordinates and normals only, which are optional:
  int min_numbers = 3;            // minimum count of numbers per element
  int numbers = 0;                // maximum count of numbers of an element in the piece
  int broken_line = 0;            // first line with unusable numbers; 0 for none
  std::vector<int> of_corners{};  // element of each corner of the piece so far; -1 for none
};

/// Increments the count of elements. Throws InputError beyond 2^31 - 1.
void count_one(const Scanner& in, ObjElements& elements);

/// Reads the rest of the line of a texture coordinate or a normal. Invalid numbers are recorded rather than
/// thrown, since they are common, such as "nan" for faces without area.
void read_numbers(Scanner& in, ObjElements& elements);

/// Converts `text`, the index of an element in the face corner `corner`, to a 0-based id. Throws InputError
/// unless it is an integer that can refer to an element.
int read_index(const Scanner& in, std::string_view text, std::string_view corner, ObjElements& elements);

/// The same for a texture coordinate or a normal, which is assigned to corner `number` of the piece.
void read_corner_index(const Scanner& in, std::string_view text, std::string_view corner, size_t number,
                       ObjElements& elements);

/// The elements of one kind in all pieces of the text, in order.
using ObjElementPieces = std::vector<const ObjElements*>;

/// Throws InputError if a face refers to an element that does not exist. Positive indices may refer to later
/// elements, so this can be checked only after reading all pieces.
void check_max_index(const std::string& name, const ObjElementPieces& pieces);

/// Adds texture coordinates or normals to the vertex data of the file or, where vertices have several or some
/// corners none, stores them in `corners`, with a warning for formats that have no such data. Reports in
/// `not_kept` if they are not kept. Pre-condition: in every piece `of_corners` has an entry per
/// corner, unless the text has no elements of this kind.
void keep_elements(const ObjElementPieces& pieces, const CornerDataKind& kind, MeshFile& file,
                   PolygonCorners& corners, std::vector<std::string>& not_kept);

}  // namespace hooke
