// A multilevel preconditioner: long waves of a relaxation move in one step what plain descent moves in
// hundreds. J. Bramble, J. Pasciak, J. Xu, "Parallel multilevel preconditioners", 1990 (BPX), on grids in
// space.
#pragma once

#include "hooke/core/symmetric_matrix.h"
#include "hooke/core/types.h"
#include "hooke/filter/retraction.h"
#include "hooke/integrator/relaxation.h"

namespace hooke {

/// Sum over levels of P P^T, where P spreads the values of a grid's nodes to the vertices by trilinear hats.
/// Each grid has cells twice as wide as the one before; only nodes near vertices exist.
class GridHierarchy {
 public:
  /// The finest cells are `cell` wide. The grids lie in a frame that the points define, so that a turned mesh
  /// has turned grids.
  GridHierarchy(const Mat3X& points, double cell);

  /// A column per node of the finest grid.
  struct Correction {
    Mat3X at_nodes;
  };

  /// What all levels make of a residual, one column per vertex: the sum over levels of P^T, brought to the
  /// finest grid.
  Correction solve(const Mat3X& residual) const;

  /// vectors += weight * P correction. With that of a residual they get (sum over levels of P P^T) residual.
  void add(const Correction& correction, double weight, Mat3X& vectors) const;

  int level_count() const { return static_cast<int>(levels_.size()); }

 private:
  struct Part;
  std::vector<Part> part_vertices() const;
  Mat3X collect(const Mat3X& residual) const;

  struct Weighted {
    std::array<int, 8> node;
    std::array<float, 8> weight;
  };
  struct Level {
    int nodes = 0;
    std::vector<Weighted> to_coarser;  // per node; empty on the coarsest level
  };
  /// Where a vertex lies on the finest grid.
  struct Place {
    int cell;
    Eigen::Vector3f within;  // from the cell's lowest node, in cells
  };
  /// Vertices whose residuals are summed on their own, and the range of the nodes they have.
  struct Part {
    size_t first_vertex = 0, last_vertex = 0;
    int first_node = 0, last_node = 0;  // the last ones excluded
  };
  std::vector<Place> places_;              // per vertex
  std::vector<Part> parts_;                // of the vertices
  std::vector<std::array<int, 8>> cells_;  // nodes of the cells of the finest grid that hold vertices
  std::vector<Level> levels_;
};

// What a gradient is multiplied with to become a step: the inverse curvature around each vertex, for short
// waves, and grids, for long ones.

struct PreconditionerOptions {
  double grid_cell = 4;     // width of the finest grid's cells, in mean target lengths
  double grid_weight = .3;  // of each grid, over the median curvature
};

/// H0 = D^-1 + weight * sum over grids of P P^T, D the curvatures by size (see local_newton.h).
class Preconditioner {
 public:
  Preconditioner(const Relaxation& r, const PreconditionerOptions& options)
      : options_(options), grids_(r.positions.points, options.grid_cell) {}

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
