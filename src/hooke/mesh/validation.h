// Validation of points and triangles that should form an oriented manifold: what is wrong, where, and what to
// do.
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
  // A mesh with one of these is still acceptable:
  zero_area_faces,
  isolated_vertices,      // in no face
  unconnected_triangles,  // no two of the faces share a vertex
};

/// Maximum number of locations kept per problem.
inline constexpr size_t max_locations = 5;

struct Problem {
  ProblemKind kind;
  size_t count = 0;           // how often it occurs
  std::vector<int> faces;     // face ids of the first locations, at most max_locations
  std::vector<int> vertices;  // vertex ids of the first locations; two consecutive ones for an edge
};

/// Finds each kind of problem at most once, in the order of the enumeration. If one of the first four kinds
/// is present, the checks that require their absence are skipped. Zero area is zero up to the rounding of the
/// coordinates.
/// `fans`, if given, receives the fans of the vertices, unless there are problems of these four kinds.
std::vector<Problem> find_problems(const Mat3X& points, const std::vector<Triangle>& triangles,
                                   VertexFans* fans = nullptr);

// Acceptance of a mesh, with messages.

/// The name in snake case, for scripts: "non_manifold_edge".
std::string name_of(ProblemKind kind);

/// Whether a mesh with this problem can be processed; the problem is then a warning.
bool is_acceptable(ProblemKind kind);

/// Whether the problem is a junction, which can be kept, see junctions.h.
bool is_junction(ProblemKind kind);

/// The origin of the triangles, for messages.
struct MeshSource {
  std::string name;              // of the file, printable
  std::vector<int> face;         // per triangle: face of the file; empty: the same ids
  std::vector<int> line;         // per face of the file; empty: unknown
  bool repaired = false;         // messages then do not name the option that repairs a mesh
  bool keeps_junctions = false;  // is_junction() then is no problem
};

/// The face of the file and its line, for messages: "4 (line 9)".
std::string face_text(int triangle, const MeshSource& source);

/// Throws MeshError "NAME: what, where; what was expected; what to do" for problems that are not acceptable.
/// Returns the others as warnings, with name_of() as code.
Warnings require_valid(const Mat3X& points, const std::vector<Triangle>& triangles, const MeshSource& source);

/// Throws MeshError if the bounding box of the points is so small or so large that squares of areas would
/// underflow or overflow.
void require_workable_size(const Mat3X& points, const std::string& name);

}  // namespace hooke
