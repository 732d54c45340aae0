// Creases between the facets of a part: where the target length resolves the facets, as opposed to those that
// coarsely stand for a round body.
#pragma once

#include "hooke/mesh/adjacency.h"

namespace hooke {

/// Minimum length of a sharp edge, and minimum height of its faces, in target lengths, for the edge to be
/// certainly no noise.
constexpr double resolved_length = 1.5;

/// Length of the edge over the mean target length at its ends.
double length_over_target(const Mat3X& points, const Adjacency& adjacency,
                          const std::vector<double>& vertex_length, int edge);

/// Marks in `kept`, per edge, the sharp edges that are resolved or divide flat regions, and weaker edges
/// between resolved flat regions. `angles`: between the faces at each edge, in degrees, 0 on the boundary;
/// sharp are those above `sharp_angle`. `vertex_length` is the target length at each vertex.
void add_facet_creases(const Mat3X& points, const Adjacency& adjacency,
                       const std::vector<double>& vertex_length, const std::vector<double>& angles,
                       double sharp_angle, std::vector<char>& kept);

}  // namespace hooke
