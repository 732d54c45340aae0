// Target lengths: what each edge wants to be.
#pragma once

#include "hooke/connectivity.h"

namespace hooke {

/// Target lengths of the springs, in the unit of the points.
struct TargetLengths {
  std::vector<double> edge;  // mean of the ends: the rule that always keeps the triangle inequality
  std::vector<double> face;  // mean of the three edges
};

/// Sum of the areas of the faces.
double total_area(const Mat3X& points, const std::vector<Triangle>& faces);

/// L* = sqrt(4 A / (sqrt 3 F)): the edge of F equilateral triangles that cover the area A.
double natural_length(double area, std::size_t face_count);

/// Spreads target lengths given per vertex to edges and faces.
TargetLengths spread_target_lengths(const Connectivity& connectivity,
                                    const std::vector<double>& vertex_length);

}  // namespace hooke
