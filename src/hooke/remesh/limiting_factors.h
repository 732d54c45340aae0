// Limiting factors of the minimum angle: what restricts the vertices of a result, and which of these limits
// bounds the angle of a given face.
#pragma once

#include "hooke/core/types.h"

namespace hooke {

struct ConstraintOptions;
class Guards;
struct Workspace;

struct WorstFace;

/// The limits of a vertex, as bits.
enum VertexLimit : unsigned char {
  not_limited = 0,
  limited_by_boundary = 1,  // lies on the boundary
  limited_by_crease = 2,    // lies on a crease
  limited_at_corner = 4,    // fixed where feature curves of the input end, turn or overlap
  limited_by_request = 8,   // fixed by the options
  limited_by_guard = 16,    // next to a face or an edge that is at a limit of the guards
  put_back = 32,            // put back to where it was, to keep the surface, see preserving_remesh()
};

/// The limits of each vertex of the result, as bits of VertexLimit. `asked`: the options from which the
/// constraints of the workspace were made.
std::vector<unsigned char> vertex_limits_of_result(const Workspace& work, const Guards& guards,
                                                   const ConstraintOptions& asked);

/// Names of what bounds the minimum angle of a face. If the bound by the connectivity is reached (see
/// angle_bound.h), these are the kinds of the vertices that set it: "corner", "fixed", "crease", "boundary",
/// or "valence" for others. Otherwise they are the limits of the face's own vertices, including "put_back"
/// and "guard", or "lengths" if there is only the objective of equal edges. Pre-condition: the face was
/// measured on the mesh to which `vertex_limits` belongs.
std::vector<std::string> limiting_factors(const WorstFace& face,
                                          const std::vector<unsigned char>& vertex_limits);

}  // namespace hooke
