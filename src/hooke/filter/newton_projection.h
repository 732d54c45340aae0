// Newton's method along the gradient onto the zero level of a field [16].
// "Hooke's Optimization for 3D triangular mesh", section 3.3.
#pragma once

#include "hooke/core/types.h"
#include "hooke/filter/surface.h"

namespace hooke {

struct NewtonOptions {
  double tolerance = 1e-6;    // |psi| / |grad psi| at the foot, a length
  double longest_step = .5;   // a length; longer steps are shortened to it
  double longest_move = 2;    // from the start, a length
  double min_gradient = .01;  // of a field that is a distance near its surface
  double convergence = 0;     // error of a step over the square of the distance before it, 1 / length, as far
                              // as it is known beforehand; 0: the first step is always looked at
  int max_steps = 12;
};

/// Moves x to the zero level of psi. The last step is not looked at where the rate of convergence says that
/// it ends within the tolerance; the normal is then that of the point before it. A sample of value and
/// gradient zero says that the field does not reach the point (no_cover). Where the status is not
/// `converged`, point and normal are those of the start of the search and must not be used.
Projection project_by_newton(const ScalarField& psi, const Vec3& x, int hint, const NewtonOptions& options);

}  // namespace hooke
