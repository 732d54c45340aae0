// Is this a mesh we can work on: an oriented manifold with area? If not: what is wrong, where, and what
// helps.
#pragma once

#include <string>
#include <vector>

#include "hooke/core/types.h"
#include "hooke/mesh/mesh_problems.h"

namespace hooke {

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
