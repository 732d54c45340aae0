// A multilevel preconditioner for gradients: the inverse curvature of the energy around each vertex for short
// waves, and a hierarchy of grids in space for long waves, which plain descent needs hundreds of steps for.
// J. Bramble, J. Pasciak, J. Xu, "Parallel multilevel preconditioners", 1990 (BPX).
//
// The grids pay on large meshes: without them the edges of a torus of 100 000 vertices vary by 11.9 % instead
// of 7.8 % in mode `flip`, by 28.4 % instead of 27.6 % in `fixed` and by 5.9 % instead of 5.7 % in `adapt`,
// in no less time; of 25 000 vertices with a boundary by 9.5 % instead of 8.3 % in `flip`. Below 5000
// vertices little depends on them.
#pragma once

#include "hooke/core/symmetric_matrix.h"
#include "hooke/core/types.h"
#include "hooke/filter/retraction.h"
#include "hooke/integrator/relaxation.h"

namespace hooke {

/// Sum over levels of P P^T, where P interpolates values at a grid's nodes to the vertices by trilinear hat
/// functions. Each grid has cells twice as wide as the previous one; only nodes near vertices exist.
class GridHierarchy {
 public:
  /// `cell` is the width of the finest cells. The grids lie in a frame defined by the points, so that they
  /// rotate with the mesh.
  GridHierarchy(const Mat3X& points, double cell);

  /// One column per node of the finest grid.
  struct Correction {
    Mat3X at_nodes;
  };

  /// Restricts a residual, one column per vertex, to all levels (P^T) and sums the levels on the finest grid.
  Correction solve(const Mat3X& residual) const;

  /// vectors += weight * P correction. After solve(residual) this adds (sum over levels of P P^T) residual.
  void add(const Correction& correction, double weight, Mat3X& vectors) const;

  int level_count() const { return static_cast<int>(levels_.size()); }

 private:
  struct Part;
  std::vector<Part> part_vertices() const;
  Mat3X collect(const Mat3X& residual) const;

  struct Interpolation {
    std::array<int, 8> node;
    std::array<float, 8> weight;
  };
  struct Level {
    int nodes = 0;
    std::vector<Interpolation> to_coarser;  // per node; empty on the coarsest level
  };
  /// The position of a vertex in the finest grid.
  struct GridPosition {
    int cell;
    Eigen::Vector3f within;  // offset from the cell's lowest node, in cells
  };
  /// Vertices whose residuals are summed separately, and the range of their nodes.
  struct Part {
    size_t first_vertex = 0, last_vertex = 0;
    int first_node = 0, last_node = 0;  // half-open range
  };
  std::vector<GridPosition> grid_positions_;  // per vertex
  std::vector<Part> parts_;                   // of the vertices
  std::vector<std::array<int, 8>> cells_;     // nodes of the cells of the finest grid that hold vertices
  std::vector<Level> levels_;
};

/// H0 = D^-1 + weight * sum over grids of P P^T, with D the absolute local Hessians (see gauss_seidel.h).
class Preconditioner {
 public:
  explicit Preconditioner(const Relaxation& r);

  /// Updates the local curvatures. Must be called before apply().
  void refresh(Relaxation& r);

  /// vectors = H0 vectors, in the tangent space.
  void apply(const Relaxation& r, Mat3X& vectors) const;

 private:
  GridHierarchy grids_;
  std::vector<SymmetricMatrix> inverse_;
  double grid_weight_ = 0;
};

}  // namespace hooke
