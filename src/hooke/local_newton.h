// Newton's method vertex by vertex (nonlinear Gauss-Seidel): each vertex in turn goes to the minimum of the
// energy around it, in its tangent plane, guarded. Coloured, so that vertices of one colour move at once and
// the result does not depend on the number of threads.
#pragma once

#include "hooke/integrator.h"

namespace hooke {

/// How the energy around one vertex curves in the directions the vertex may move in.
struct LocalCurvature {
  Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();  // |H|^-1 in the tangent space, zero across it
  double mean = 0;                                    // mean of the eigenvalues of |H|
};

/// The Hessian by differences of the gradient in the tangent space of the vertex. Its eigenvalues count by
/// their size, and those below a part of the largest are raised to it: the step -inverse * gradient descends
/// from saddles too. A vertex without faces has none. Moves the point of the vertex and puts it back;
/// `gradient` is that at the point.
LocalCurvature local_curvature(const Relaxation& relaxation, int vertex, const Vec3& gradient);

struct LocalNewtonOptions {
  double max_move = .5;  // of a vertex, in its target lengths
  double over_relaxation = 1;
  int max_halvings = 5;  // of a move that breaks a guard or raises the energy, before the vertex stays
};

/// One sweep over the colours; vertices with `active` false stay (empty: all move). Returns how far each
/// vertex moved, in its target length.
std::vector<double> local_newton_sweep(Relaxation& relaxation, const std::vector<char>& active,
                                       const LocalNewtonOptions& options);

}  // namespace hooke
