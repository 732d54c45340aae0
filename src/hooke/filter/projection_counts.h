// How projections to the surface ended, and how many ended so.
#pragma once

#include <array>

namespace hooke {

/// How a projection ended. All but `converged` used the fallback; the report counts them.
enum class ProjectionStatus : unsigned char {
  converged,
  no_cover,       // no patch of the field covers the point
  flat_gradient,  // |grad psi| too small for a Newton step
  too_far,        // Newton's method left the neighbourhood of its start
  step_limit,     // Newton's method did not converge
};

/// Number of projections, in total and by status, and of field evaluations.
struct ProjectionCounts {
  long long calls = 0;
  long long evaluations = 0;
  std::array<long long, 5> by_status{};  // indexed by ProjectionStatus

  ProjectionCounts& operator+=(const ProjectionCounts& other);
};

}  // namespace hooke
