// Discrete curvatures of a triangle mesh.
// M. Meyer, M. Desbrun, P. Schroeder, A. H. Barr, "Discrete differential-geometry operators for triangulated
// 2-manifolds", 2003.
#pragma once

#include <vector>

#include "hooke/mesh/connectivity.h"

namespace hooke {

/// NaN where a curvature is not defined: on the boundary, at isolated vertices, beside faces without area.
struct VertexCurvature {
  std::vector<double> mean;      // 1/length, unsigned: half the length of the mean curvature normal
  std::vector<double> gaussian;  // 1/length^2: angle defect over the mixed area
};

VertexCurvature measure_curvature(const Mat3X& points, const Connectivity& connectivity);

}  // namespace hooke
