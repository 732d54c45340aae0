// The distance from one surface to another, sampled.
#pragma once

#include "hooke/measured_surface.h"

namespace hooke {

struct MaxRms {
  double max = 0;
  double rms = 0;
};

/// Squared distances to another surface, at the points that measure_distance() asks for: ten a face, many of
/// them shared.
struct DistanceSamples {
  std::vector<double> vertices;  // 0 at isolated ones: they are no part of the surface
  std::vector<double> edges;     // midpoints
  std::vector<ClosestPoint> centres;
  std::vector<std::array<double, 3>> quarters;  // centres of the quarters at the three corners
};

/// Quickest where faces with equal ids lie close to each other. Infinite when `to` has no faces.
DistanceSamples sample_distances(const MeasuredSurface& from, const MeasuredSurface& to);

/// Greatest sample, and the root of the mean square over the area of `from`.
MaxRms measure_distance(const MeasuredSurface& from, const DistanceSamples& samples);

}  // namespace hooke
