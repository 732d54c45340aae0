// The bound of a face's least angle where creases part the faces about a vertex.
#pragma once

#include "hooke/measure/measured_surface.h"
#include "hooke/measure/quality.h"

namespace hooke {

/// Bounds the least angles of these faces of the surface anew, for creases that stay: what the angles sum to
/// stays as it is in each sector of a vertex on its own, see angle_bound.h. Ids are the surface's.
void bound_between_creases(std::vector<WorstFace>& faces, const MeasuredSurface& surface,
                           const std::vector<Edge>& creases);

}  // namespace hooke
