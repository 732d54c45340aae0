// A mesh from points and triangles that were not made by a reader: validated like those of a file.
#pragma once

#include <string>

#include "hooke/mesh/mesh.h"
#include "hooke/mesh/repair.h"

namespace hooke {

/// A mesh that can be remeshed.
struct ValidMesh {
  TriMesh mesh;              // vertices and faces in the order given
  MemoryOrder memory_order;  // with the adjacency
  Warnings warnings;         // of validation, see require_valid()
  MeshOrigin origin = {};    // if the mesh was repaired: ids before are those of the arrays
  Notes repairs = {};        // what the repair did
};

/// Validates points, one column per vertex in any unit of length, and triangles of vertex ids (0-based,
/// counter-clockwise as seen from outside), and builds their mesh. `name` begins all messages. Throws
/// MeshError if they are not an oriented manifold with area: an id that is no vertex, a coordinate that is
/// not finite, an edge with three faces, neighbours of opposite orientation, no faces, or too small or too
/// large.
ValidMesh make_valid_mesh(const Mat3X& points, const std::vector<Triangle>& triangles,
                          const std::string& name);

/// The same after a repair, if the options ask for one.
ValidMesh make_valid_mesh(const Mat3X& points, const std::vector<Triangle>& triangles,
                          const std::string& name, const RepairOptions& options);

}  // namespace hooke
