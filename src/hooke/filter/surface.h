// The surface as the optimizer sees it: a projection and a shape operator. A fitted field, a closest-point
// search and an analytic surface can all serve as one; a field does by Newton's method [16].
#pragma once

#include <concepts>
#include <utility>

#include "hooke/core/symmetric_matrix.h"
#include "hooke/core/types.h"
#include "hooke/filter/filter.h"
#include "hooke/mesh/adjacency.h"

namespace hooke {

/// Second-order shape of a surface: a step d along it turns its unit normal n by S d and leads to x + d - (d
/// . S d / 2) n.
struct ShapeOperator {
  SymmetricMatrix shape = {};  // S for outward normals, 1 / length; 1 / R on a sphere
  float change = 0;            // rms change of S along the edges at a vertex; the maximum over its one-ring
};

/// The shape operator where nothing is known of it: its change is infinite.
ShapeOperator unknown_shape_operator();

/// Least-squares fit of S to the edges at each vertex; unknown where they do not span a plane.
std::vector<ShapeOperator> shape_operators(const Mat3X& points, const Mat3X& normals,
                                           const Adjacency& adjacency);

/// A point projected to the surface.
struct Projection {
  Vec3 point;
  Vec3 normal;  // unit, outward
  int hint;     // vertex of the fitted mesh next to it: where the next projection starts to search
  ProjectionStatus status = ProjectionStatus::converged;
  int evaluations = 0;  // of the field
};

/// A surface given by two functions, which must be safe to call from several threads at once.
class Surface {
 public:
  /// Projects a point that is tracked near the vertex `hint` to within `tolerance` (a length) of the
  /// surface.
  using Project = std::function<Projection(const Vec3& point, int hint, double tolerance)>;
  /// Shape operator near the vertex `hint`.
  using ShapeOperatorAt = std::function<ShapeOperator(int hint)>;

  template <typename F>
  requires(!std::same_as<F, Surface> && std::convertible_to<F, Project>) Surface(
      F project, ShapeOperatorAt shape_operator_at = [](int) { return ShapeOperator{}; })
      : project_(std::move(project)), shape_operator_(std::move(shape_operator_at)) {}

  Projection operator()(const Vec3& point, int hint, double tolerance) const {
    return project_(point, hint, tolerance);
  }
  ShapeOperator shape_operator(int hint) const { return shape_operator_(hint); }

 private:
  Project project_;
  ShapeOperatorAt shape_operator_;
};

// Projection by Newton's method along the gradient onto the zero level set of a field [16].
// "Hooke's Optimization for 3D triangular mesh", section 3.3.

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
