// Target lengths: what each edge wants to be.
#pragma once

#include "hooke/core/uniform_vector.h"
#include "hooke/mesh/adjacency.h"

namespace hooke {

/// Target lengths of the springs, in the unit of the points.
struct TargetLengths {
  UniformVector edge;  // mean of the ends: the rule that always keeps the triangle inequality
  UniformVector face;  // mean of the three edges
};

/// L* = sqrt(4 A / (sqrt 3 F)): the edge of F equilateral triangles that cover the area A.
double natural_length(double area, std::size_t face_count);

/// The edge length at which equilateral triangles that are all alike would be as many on the mesh as those
/// that have the target length at every place: L^-2 is the mean over the area of L_f^-2. Pre-condition: there
/// are faces.
double covering_length(const Mat3X& points, const Adjacency& adjacency, const TargetLengths& targets);

/// Mean of the target lengths over the edges that a mesh which has them would have: many where they are
/// small. Exact when all are the same. Pre-condition: there are edges.
double mean_length(const Mat3X& points, const Adjacency& adjacency, const TargetLengths& targets);

/// Spreads target lengths given per vertex to edges and faces.
TargetLengths spread_target_lengths(const Adjacency& adjacency, const std::vector<double>& vertex_length);

}  // namespace hooke
