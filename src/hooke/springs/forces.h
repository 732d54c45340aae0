// The two forces of the damped evolution: strings along the edges and torques on the faces.
// "Hooke's Optimization for 3D triangular mesh", sections 3.1 and 3.2, equations [2]-[10].
#pragma once

#include <span>

#include "hooke/core/types.h"
#include "hooke/mesh/adjacency.h"

namespace hooke {

/// F_string: every edge pulls its ends together when it is longer than its target length and pushes them
/// apart when it is shorter; minus the gradient of the sum of spring_potential over the edges. [3][4]
/// `points` and `forces` are 3 x |V|; `target_lengths` has one positive length per edge. Forces are lengths.
/// An edge of length 0 has no direction and gives no force.
void string_forces(const Eigen::Ref<const Mat3X>& points, const Adjacency& adjacency,
                   std::span<const double> target_lengths, Eigen::Ref<Mat3X> forces);

/// F_torque: every face turns about its centre toward the normals of the faces across its edges. [5]-[10]
/// `points` and `forces` are 3 x |V|. The forces have no unit: they do not change with the size of the mesh.
/// Not the gradient of an energy.
///
/// Normals may all point inward, as in the paper, or all outward: [9] needs n^j x n^{j,j*} only, which is
/// n^j x n^{j*} times a function of their angle, and both are the same for -n^j and -n^{j*}.
/// A degenerate face has no normal: it neither turns nor turns others. Two faces folded onto each other
/// (within about 1e-6 of theta = pi) do not turn each other either: [6] ends before pi, where the force is
/// infinite and rounding decides its direction.
void torque_forces(const Eigen::Ref<const Mat3X>& points, const Adjacency& adjacency,
                   Eigen::Ref<Mat3X> forces);

}  // namespace hooke
