// The size of a mesh: bounding box, area and volume.
#pragma once

#include <optional>

#include "hooke/mesh/adjacency.h"

namespace hooke {

struct Extent {
  Vec3 lower = Vec3::Zero();  // bounding box of the vertices that have a face
  Vec3 upper = Vec3::Zero();
  double diagonal = 0;
  double area = 0;
  std::optional<double> volume;  // signed, positive if the faces are oriented outward; none for an open mesh
};

Extent measure_extent(const Mat3X& points, const Adjacency& adjacency);

/// Sum of the areas of the faces.
double total_area(const Mat3X& points, const std::vector<Triangle>& faces);

/// Diagonal of the bounding box of the points, 0 without points.
double box_diagonal(const Mat3X& points);

}  // namespace hooke
