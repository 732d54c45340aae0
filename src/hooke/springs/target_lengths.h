// Target lengths of edges and faces, and their averages over a mesh.
#pragma once

#include "hooke/core/uniform_vector.h"
#include "hooke/mesh/adjacency.h"

namespace hooke {

/// Target lengths of the springs, in the unit of the points.
struct TargetLengths {
  /// Where they are not given for single edges, the mean of the ends, which always satisfies the triangle
  /// inequality, times the rest ratio if there is one.
  UniformVector edge;
  UniformVector face;  // mean of the three edges; with rest ratios see rest_ratios.h
};

/// L* = sqrt(4 A / (sqrt 3 F)): the edge length of F equilateral triangles that cover the area A.
double natural_length(double area, std::size_t face_count);

/// The natural length of the part of the mesh that each vertex is on, but at least half its mean edge, as a
/// part may be a sliver, and a thousandth of the natural length of the whole; that of the whole for a vertex
/// without faces, or for all if no part's differs much from it. Parts are shells, together with those whose
/// boundaries they touch; `joined` are the copies of vertices, see mesh/junctions.h. Pre-condition: there are
/// faces.
UniformVector natural_lengths_of_parts(const Mat3X& points, const Adjacency& adjacency,
                                       const std::vector<int>& joined);

/// The length L of uniform equilateral triangles that would cover the mesh in the same number as triangles of
/// the local target length: L^-2 is the area mean of L_f^-2. Pre-condition: there are faces.
double covering_length(const Mat3X& points, const Adjacency& adjacency, const TargetLengths& targets);

/// Mean target length over the edges of a mesh that has these lengths; short edges count more because there
/// are more of them. Exact if all lengths are the same. Pre-condition: there are edges.
double mean_length(const Mat3X& points, const Adjacency& adjacency, const TargetLengths& targets);

/// Target lengths of edges that are given one by one; those of the faces are their means.
TargetLengths from_edge_lengths(const Adjacency& adjacency, std::vector<double> edge_length);

/// Has each face three edges of one target length? Then lengths differ at most between parts of the mesh.
bool are_even(const Adjacency& adjacency, const TargetLengths& targets);

/// The least angle of the triangles with these edges, degrees; those whose edges make none do not count. 60
/// without any.
double least_rest_angle(const Adjacency& adjacency, const TargetLengths& targets);

/// Target lengths of edges and faces from those of the vertices.
TargetLengths spread_target_lengths(const Adjacency& adjacency, const std::vector<double>& vertex_length);

}  // namespace hooke
