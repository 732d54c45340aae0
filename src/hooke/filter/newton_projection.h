// Projection by Newton's method along the gradient onto the zero level set of a field [16].
// "Hooke's Optimization for 3D triangular mesh", section 3.3.
#pragma once

#include "hooke/core/types.h"
#include "hooke/filter/surface.h"

namespace hooke {

struct NewtonOptions {
  double tolerance = 1e-6;   // |psi| / |grad psi| at the projection, a length
  double longest_step = .5;  // a length; longer steps are shortened to it
  double longest_move = 2;   // maximum distance from the start, a length
  static constexpr double min_gradient =
      .01;                 // minimum norm of the gradient, which is 1 for a distance field
  double convergence = 0;  // estimated error of a step over the squared distance before it, 1 / length;
                           // 0: unknown, the first step is always evaluated
};

/// Projects x to the zero level set of psi. The last step is not evaluated if the rate of convergence shows
/// that it ends within the tolerance; the normal is then that of the point before it. A sample with zero
/// value and gradient means that the field does not cover the point (no_cover). Unless the status is
/// `converged`, point and normal are x and zero and must not be used.
Projection project_by_newton(const ScalarField& psi, const Vec3& x, int hint, const NewtonOptions& options);

}  // namespace hooke
