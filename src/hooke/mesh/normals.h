// Normals of faces and vertices, outward if the faces are counter-clockwise seen from outside; the edges at
// which they turn; and mean edge lengths.
#pragma once

#include <span>

#include "hooke/core/types.h"
#include "hooke/mesh/adjacency.h"

namespace hooke {

/// Unit normal per face; zero for a face without area.
Mat3X face_normals(const Eigen::Ref<const Mat3X>& points, const Adjacency& adjacency);

/// The same, but zero also for a face whose area is only rounding, see face_shape().
Mat3X certain_face_normals(const Eigen::Ref<const Mat3X>& points, const Adjacency& adjacency);

/// Unit normal per vertex; zero for a vertex without faces of positive area. The faces are weighted so that
/// the normal is exact if the one-ring lies on a sphere (N. Max, "Weights for computing vertex normals from
/// facet normals", 1999).
Mat3X vertex_normals(const Eigen::Ref<const Mat3X>& points, const Adjacency& adjacency);

/// Newell's normal of a polygon, of unit length; zero without area. Pre-condition: it has corners.
Vec3 newell_normal(const Mat3X& points, std::span<const int> corners);

/// Mean length of the edges at each vertex; zero for a vertex without edges.
Eigen::VectorXd mean_edge_lengths(const Eigen::Ref<const Mat3X>& points, const Adjacency& adjacency);

/// The edges whose faces meet at more than `angle` degrees, ascending.
std::vector<int> sharp_edges(const Mat3X& points, const Adjacency& adjacency, double angle);

}  // namespace hooke
