// The size of a mesh: box, area, volume.
#pragma once

#include <optional>

#include "hooke/mesh/adjacency.h"

namespace hooke {

struct Extent {
  Vec3 lower = Vec3::Zero();  // box of the vertices that have a face
  Vec3 upper = Vec3::Zero();
  double diagonal = 0;
  double area = 0;
  std::optional<double> volume;  // signed, positive when the faces look outward; none for an open mesh
};

Extent measure_extent(const Mat3X& points, const Adjacency& adjacency);

/// Sum of the areas of the faces.
double total_area(const Mat3X& points, const std::vector<Triangle>& faces);

/// Diagonal of the box of the points.
double box_diagonal(const Mat3X& points);

}  // namespace hooke
