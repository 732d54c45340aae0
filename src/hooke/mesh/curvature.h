// Curvatures of a triangle mesh: discrete mean and Gaussian curvature, and the largest principal curvature by
// fitting quadrics.
// M. Meyer, M. Desbrun, P. Schroeder, A. H. Barr, "Discrete differential-geometry operators for triangulated
// 2-manifolds", 2003; F. Cazals, M. Pouget, "Estimating differential quantities using polynomial fitting of
// osculating jets", 2005.
#pragma once

#include <vector>

#include "hooke/mesh/adjacency.h"

namespace hooke {

/// Meyer et al. NaN where a curvature is not defined: on the boundary, at isolated vertices, beside faces
/// without area.
struct VertexCurvature {
  std::vector<double> mean;      // 1/length, unsigned: half the length of the mean curvature normal
  std::vector<double> gaussian;  // 1/length^2: angle defect over the mixed area
};

VertexCurvature measure_curvature(const Mat3X& points, const Adjacency& adjacency);

/// The same from quadrics: half the sum of the principal curvatures, unsigned, and their product, of the
/// quadric fitted to two rings as for largest_curvatures(), creases or not. Smoother than the above, and not
/// misled by bad triangles. NaN on the boundary and at isolated vertices.
VertexCurvature fitted_curvature(const Mat3X& points, const Adjacency& adjacency);

/// Do the faces come to a point at the vertex, as at the tip of a cone: do they span at least 70 degrees less
/// than a full turn? Not on the boundary or on a crease.
bool is_tip(const Mat3X& points, const Adjacency& adjacency, int vertex);

/// Maximum curvature at each vertex, 1/length, 0 at a vertex without faces: of the boundary or a crease that
/// goes through it, and the absolute principal curvatures of the surface on each side of a crease. A quadric
/// is fitted to two rings around the vertex, and a third where they have fewer than ten vertices (Cazals and
/// Pouget): the vertices must lie on the surface, but the triangles need not be good. Vertices whose normals
/// differ by more than 78 degrees (on the other side of a thin sheet) are left out, unless too few remain.
std::vector<double> largest_curvatures(const Mat3X& points, const Adjacency& adjacency);

}  // namespace hooke
