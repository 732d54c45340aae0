#include "hooke/filter/newton_projection.h"

#include <algorithm>

namespace hooke {

Foot project_by_newton(const ScalarField& psi, const Vec3& x, int anchor, const NewtonOptions& options) {
  Foot foot{x, Vec3::Zero(), anchor, FootStatus::converged, 0};
  const auto fail = [&](FootStatus status) {
    return Foot{x, Vec3::Zero(), anchor, status, foot.evaluations};
  };
  double last_distance = options.convergence > 0 ? 1 / options.convergence : 0;
  for (int step = 0; step <= options.most_steps; ++step) {
    const FieldSample s = psi(foot.point, anchor);
    ++foot.evaluations;
    if (s.value == 0 && s.gradient.isZero(0)) return fail(FootStatus::no_cover);
    const double slope = s.gradient.norm();
    if (!(slope >= options.least_gradient)) return fail(FootStatus::flat_gradient);
    const double distance = s.value / slope;
    foot.normal = s.gradient / slope;
    if (std::abs(distance) <= options.tolerance) return foot;

    foot.point -= std::clamp(distance, -options.longest_step, options.longest_step) * foot.normal;  // [16]
    if (!((foot.point - x).norm() <= options.longest_move)) return fail(FootStatus::too_far);
    // Newton converges faster and faster: the rate of the last step bounds what this one leaves.
    if (distance * distance <= options.tolerance * std::abs(last_distance)) return foot;
    last_distance = distance;
  }
  return fail(FootStatus::step_limit);
}

}  // namespace hooke
