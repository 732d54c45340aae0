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

/// Bounding box of the vertices that have a face; empty if there is none.
Eigen::AlignedBox3d box_of_faces(const Mat3X& points, const std::vector<Triangle>& faces);

/// Sum of the areas of the faces.
double total_area(const Mat3X& points, const std::vector<Triangle>& faces);

/// Diagonal of the bounding box of all points, also of those without faces; 0 without points.
double box_diagonal(const Mat3X& points);

}  // namespace hooke
