// The distance from one surface to another, sampled.
#pragma once

#include "hooke/measured_surface.h"

namespace hooke {

struct MaxRms {
  double max = 0;
  double rms = 0;
};

/// Greatest distance to the surface `to` of ten samples a face, and the root of the mean square over the area
/// of `from`. The samples are the corners, the edge midpoints and the centres of the four triangles between
/// them. Infinite when `to` has no faces. `centres`, where given, gets the closest points of the faces'
/// centres, by id.
MaxRms measure_distance(const MeasuredSurface& from, const MeasuredSurface& to,
                        std::vector<ClosestPoint>* centres = nullptr);

}  // namespace hooke
