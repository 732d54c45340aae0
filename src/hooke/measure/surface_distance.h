// The distance from one surface to another, sampled.
#pragma once

#include "hooke/measure/measured_surface.h"

namespace hooke {

struct MaxRms {
  double max = 0;
  double rms = 0;
};

/// Where a point is closest to a surface.
struct TreeFoot {
  Vec3 point = Vec3::Zero();
  long long place = -1;  // of its face in the tree's faces(); -1 where there is none
};

/// Greatest distance to the surface `to` of ten samples a face, and the root of the mean square over the area
/// of `from`. The samples are the corners, the edge midpoints and the centres of the four triangles between
/// them. Infinite when `to` has no faces. `centres`, where given, gets the closest points of the faces'
/// centres, in the order of from.tree.faces().
MaxRms measure_distance(const MeasuredSurface& from, const MeasuredSurface& to,
                        std::vector<TreeFoot>* centres = nullptr);

}  // namespace hooke
