// How a surface bends about the vertices of a mesh on it, from their normals.
#pragma once

#include <concepts>
#include <utility>

#include "hooke/core/symmetric_matrix.h"
#include "hooke/core/types.h"
#include "hooke/mesh/adjacency.h"

namespace hooke {

/// A step d along the surface turns its unit normal n by S d and leads to x + d - (d . S d / 2) n, to second
/// order.
struct ShapeOperator {
  SymmetricMatrix shape = {};  // S: the shape operator for outward normals, 1 / length; 1 / R on a sphere
  float change = 0;  // of S from a vertex to the next along the way, rms; the greatest within a ring
};

/// It may bend in any way: its change is infinite.
ShapeOperator unknown_shape_operator();

/// S in the sense of least squares over the edges about each vertex; unknown where they do not span a plane.
std::vector<ShapeOperator> shape_operators(const Mat3X& points, const Mat3X& normals,
                                           const Adjacency& adjacency);

// The surface as the optimizer sees it: a place to put points back on. A fitted field, a closest point search
// and a test's sphere all fit.

/// How a projection ended. All but `converged` used the fallback and are counted in the report.
enum class ProjectionStatus : unsigned char {
  converged,
  no_cover,       // no patch of the field reaches the point
  flat_gradient,  // |grad psi| too small for a Newton step
  too_far,        // Newton left the neighbourhood of its start
  step_limit,     // Newton did not converge
};

/// Where a point lands on the surface.
struct Projection {
  Vec3 point;
  Vec3 normal;  // unit, outward
  int hint;     // vertex of the fitted mesh next to it: the start of the next search
  ProjectionStatus status = ProjectionStatus::converged;
  int evaluations = 0;  // of the field
};

/// Its members must be safe to call from several threads at once.
class Surface {
 public:
  /// Projects a point that is tracked near the vertex `hint` to within `tolerance` (a length) of the
  /// surface.
  using Project = std::function<Projection(const Vec3& point, int hint, double tolerance)>;
  /// How it bends near the vertex `hint`.
  using Bend = std::function<ShapeOperator(int hint)>;

  template <typename F>
  requires std::convertible_to<F, Project> &&(!std::same_as<std::remove_cvref_t<F>, Surface>)Surface(
      F&& project, Bend bend = [](int) { return ShapeOperator{}; })
      : project_(std::forward<F>(project)), shape_operator_(std::move(bend)) {}

  Projection operator()(const Vec3& point, int hint, double tolerance) const {
    return project_(point, hint, tolerance);
  }
  ShapeOperator shape_operator(int hint) const { return shape_operator_(hint); }

 private:
  Project project_;
  Bend shape_operator_;
};

}  // namespace hooke
