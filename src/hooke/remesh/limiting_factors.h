// Why an angle is no larger: what holds the vertices of a result, and which of that bounds a face.
#pragma once

#include "hooke/core/types.h"

namespace hooke {

struct ConstraintOptions;
class Guards;
struct Workspace;

struct WorstFace;

/// What holds a vertex, as bits.
enum Hold : unsigned char {
  held_by_nothing = 0,
  limited_by_boundary = 1,  // slides along it or lies on it
  limited_by_crease = 2,    // slides along it or lies on it
  limited_at_corner = 4,    // stands still, where curves of the input end, turn or lie on each other
  limited_by_request = 8,   // stands still, because it was asked to
  limited_by_guard = 16,    // next to a face or an edge that is at a limit of the guards
};

/// Per vertex of the result, where `asked` is what the constraints of the work were made from.
std::vector<unsigned char> vertex_limits_of_result(const Workspace& work, const Guards& guards,
                                                   const ConstraintOptions& asked);

/// What bounds the least angle of a face, by name. Where the connectivity does, what the vertices are that
/// set the bound: "corner", "fixed", "crease", "boundary", or "valence" inside. Otherwise what holds the
/// face's own vertices, "guard" included, or "lengths" when it is only the aim of equal edges. Pre-condition:
/// the face has been measured on the mesh that has these holds.
std::vector<std::string> limiting_factors(const WorstFace& face,
                                          const std::vector<unsigned char>& vertex_limits);

}  // namespace hooke
