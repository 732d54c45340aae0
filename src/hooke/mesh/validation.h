// What can be wrong with points and triangles that should be an oriented manifold, and where.
#pragma once

#include <string>
#include <vector>

#include "hooke/core/types.h"
#include "hooke/mesh/adjacency.h"

namespace hooke {

enum class ProblemKind {
  no_faces,
  index_out_of_range,        // a corner is not a vertex
  repeated_index,            // a face uses a vertex twice
  not_finite,                // a coordinate is NaN or infinite
  duplicate_face,            // the same three vertices, in any order
  non_manifold_edge,         // three faces or more on an edge
  inconsistent_orientation,  // two faces run through their common edge in the same direction
  non_manifold_vertex,       // the faces around it form more than one fan
  no_area,                   // all faces have zero area
  // The mesh is acceptable all the same:
  zero_area_faces,
  isolated_vertices,      // in no face
  unconnected_triangles,  // no two of the faces share a vertex
};

/// At most so many places of a problem are kept.
inline constexpr size_t max_places = 10;

struct Problem {
  ProblemKind kind;
  size_t count = 0;           // how often it occurs
  std::vector<int> faces;     // the first places, at most max_places: face ids ...
  std::vector<int> vertices;  // ... and vertex ids; of an edge, both its ends follow each other
};

/// Each kind of problem at most once, in the order of the enumeration. What only makes sense in a mesh
/// without the first four is not looked for if one of them is there. Zero area is zero up to the rounding of
/// the coordinates.
/// `fans`, where given, gets the fans of the vertices, unless there are problems of these four kinds.
std::vector<Problem> find_problems(const Mat3X& points, const std::vector<Triangle>& triangles,
                                   VertexFans* fans = nullptr);

// Is this a mesh we can work on: an oriented manifold with area? If not: what is wrong, where, and what
// helps.

/// Snake case, for scripts: "non_manifold_edge".
std::string name_of(ProblemKind kind);

/// Whether a mesh with this problem can be worked on; then it is a warning.
bool is_acceptable(ProblemKind kind);

/// Where the triangles come from, for messages.
struct MeshSource {
  std::string name;       // of the file, printable
  std::vector<int> face;  // of the file, per triangle; empty: the same ids
  std::vector<int> line;  // of each face of the file; empty: not known
};

/// Throws MeshError "NAME: what, where; what was expected; what to do" for problems that are not acceptable.
/// Returns the others as warnings, with name_of as code.
Warnings require_valid(const Mat3X& points, const std::vector<Triangle>& triangles, const MeshSource& source);

/// Throws MeshError when the box of the points is so small or so large that the squares of areas would leave
/// the range of numbers.
void require_workable_size(const Mat3X& points, const std::string& name);

}  // namespace hooke
