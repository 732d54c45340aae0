// Values at the vertices and faces of a result, for pictures: how far it moved, how far it is from the input,
// how it bends, and how good it is.
#pragma once

#include "hooke/core/uniform_vector.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/attributes.h"

namespace hooke {

/// Channels by the indices of the adjacency they were measured with.
struct Fields {
  VertexData vertices;
  VertexData faces;
};

/// At vertices: `displacement`, from `start` in the same order (left out without one); `distance`, as given,
/// of the surface they came from; `mean_curvature` and `gaussian_curvature`, see measure_curvature(); and
/// `length_error`, the greatest |l - L| / L of their edges. At faces: `min_angle` in degrees. Lengths are in
/// the unit of the points. Isolated vertices have a length error of 0.
Fields measure_fields(const Mat3X& points, const Adjacency& adjacency, const UniformVector& edge_targets,
                      const std::vector<double>& distances, const Mat3X* start);

}  // namespace hooke
