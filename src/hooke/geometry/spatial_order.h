// An order in which what is close in space mostly stands close.
#pragma once

#include "hooke/core/types.h"

namespace hooke {

/// The ids [0, points.size()) along a Hilbert curve through the cube about the points; ascending where they
/// coincide. D. Hilbert, "Ueber die stetige Abbildung einer Linie auf ein Flaechenstueck", 1891.
/// Pre-condition: finite.
std::vector<int> spatial_order(const std::vector<Vec3>& points);

}  // namespace hooke
