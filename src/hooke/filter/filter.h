// What a user chooses of the filter that brings points back to the surface, and how its projections ended.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace hooke {

/// How points are projected to the surface.
enum class FilterKind {
  local,    // blended splines on patches: meshes of any size
  global,   // the paper's single dense spline [30]: a few thousand vertices
  closest,  // closest point on the faces
  none,     // points are not projected
};

/// When a new surface field is fitted: before each outer iteration that follows one in which guards limited
/// vertices, or once. Mode `adapt` always fits once.
enum class Refit { each, once };

/// The unit of the offset of the splines' second points.
enum class OffsetUnit {
  edge,  // mean edge length: at each vertex (local), of the mesh (global)
  file,  // the unit of the points, as in the paper (global)
};

/// Of a thin-plate spline. r2logr is the paper's [27]. Both kernels are conditionally positive definite of
/// order 2: they need at least an affine part.
enum class Kernel { r2logr, r3 };

struct FilterOptions {
  FilterKind kind = FilterKind::local;
  Kernel kernel = Kernel::r3;
  double offset = .3;  // rho of [13]
  OffsetUnit offset_unit = OffsetUnit::edge;
  bool inward = false;  // are the second points inside, as in the paper (global)? Otherwise they are outside
  /// Curved facets where the splines do not follow the surface, see SurfaceField::project().
  bool facets = true;
  std::size_t memory_limit_bytes = SIZE_MAX;  // of the dense fit (global)
  /// Maximum distance of the surface from the faces, in vertex lengths, where splines may overshoot: near
  /// long edges along which the normals turn.
  double max_deviation = std::numeric_limits<double>::infinity();
  double max_distance = std::numeric_limits<double>::infinity();  // likewise, in the unit of the points
};

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
