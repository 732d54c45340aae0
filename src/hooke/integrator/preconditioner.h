// What a gradient is multiplied with to become a step: the inverse curvature around each vertex, for short
// waves, and grids, for long ones.
#pragma once

#include "hooke/core/symmetric_matrix.h"
#include "hooke/integrator/integrator.h"
#include "hooke/integrator/multigrid.h"

namespace hooke {

struct PreconditionerOptions {
  double grid_cell = 4;     // width of the finest grid's cells, in mean target lengths
  double grid_weight = .3;  // of each grid, over the median curvature
};

/// H0 = D^-1 + weight * sum over grids of P P^T, D the curvatures by size (see local_newton.h).
class Preconditioner {
 public:
  Preconditioner(const Relaxation& r, const PreconditionerOptions& options)
      : options_(options), grids_(r.placement.points, options.grid_cell) {}

  /// Takes the curvatures anew. Pre-condition of apply().
  void refresh(Relaxation& r);

  /// vectors = H0 vectors, in the tangent space.
  void apply(const Relaxation& r, Mat3X& vectors) const;

 private:
  PreconditionerOptions options_;
  GridHierarchy grids_;
  std::vector<SymmetricMatrix> inverse_;
  double grid_weight_ = 0;
};

}  // namespace hooke
