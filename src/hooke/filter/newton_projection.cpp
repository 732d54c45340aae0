#include "hooke/filter/newton_projection.h"

#include <algorithm>

namespace hooke {

Projection project_by_newton(const ScalarField& psi, const Vec3& x, int hint, const NewtonOptions& options) {
  Projection projection{x, Vec3::Zero(), hint, ProjectionStatus::converged, 0};
  const auto fail = [&](ProjectionStatus status) {
    return Projection{x, Vec3::Zero(), hint, status, projection.evaluations};
  };
  double last_distance = options.convergence > 0 ? 1 / options.convergence : 0;
  constexpr int max_steps = 12;
  for (int step = 0; step <= max_steps; ++step) {
    const FieldSample s = psi(projection.point, hint);
    ++projection.evaluations;
    if (s.value == 0 && s.gradient.isZero(0)) return fail(ProjectionStatus::no_cover);
    const double slope = s.gradient.norm();
    if (!(slope >= options.min_gradient)) return fail(ProjectionStatus::flat_gradient);
    const double distance = s.value / slope;
    projection.normal = s.gradient / slope;
    if (std::abs(distance) <= options.tolerance) return projection;

    projection.point -=
        std::clamp(distance, -options.longest_step, options.longest_step) * projection.normal;  // [16]
    if (!((projection.point - x).norm() <= options.longest_move)) return fail(ProjectionStatus::too_far);
    // Convergence accelerates: the rate of the last step bounds the error that this one leaves.
    if (distance * distance <= options.tolerance * std::abs(last_distance)) return projection;
    last_distance = distance;
  }
  return fail(ProjectionStatus::step_limit);
}

}  // namespace hooke
