// The forces of the damped evolution: strings along the edges and torques on the faces, and altitude springs,
// which the paper has not.
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

/// Energy of the strings, relative to their rest lengths: the sum of U(l; L) / L^2 over the edges.
double string_energy(const Eigen::Ref<const Mat3X>& points, const Adjacency& adjacency,
                     std::span<const double> target_lengths);

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

/// F_altitude: the modified Hooke's law [4] on the altitudes of the faces, its repulsive branch only. An
/// altitude h below h0 = (sqrt 3 / 2) L_f, L_f the mean target length of the face's edges, pushes corner and
/// foot apart by a force that grows like 1 / h. The strings have nothing that keeps a face from collapsing.
///
/// Altitudes are measured across the surface: `normals` are its unit normals at the points, 3 x |V| at least,
/// and each face is projected along their mean, so that it cannot turn over by leaning out of the surface. A
/// face that is turned over already, and all if `normals` is null, are measured in their own plane. Adds the
/// forces, lengths, times `weight` to `forces`.
void add_altitude_forces(const Eigen::Ref<const Mat3X>& points, const Mat3X* normals,
                         const Adjacency& adjacency, std::span<const double> target_lengths, double weight,
                         Eigen::Ref<Mat3X> forces);

/// The energy of these springs: the sum of U(h; h0) / L_f^2.
double altitude_energy(const Eigen::Ref<const Mat3X>& points, const Mat3X* normals,
                       const Adjacency& adjacency, std::span<const double> target_lengths);

}  // namespace hooke
