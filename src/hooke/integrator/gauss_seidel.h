// Newton's method vertex by vertex (nonlinear Gauss-Seidel): each vertex in turn goes to the minimum of the
// energy around it, in its tangent plane, guarded.
#pragma once

#include "hooke/integrator/relaxation.h"
#include "hooke/integrator/vertex_ring.h"

namespace hooke {

using Mat32 = Eigen::Matrix<double, 3, 2>;

/// How the energy around one vertex curves in the directions the vertex may move in.
struct LocalCurvature {
  Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();  // |H|^-1 in the tangent space, zero across it
  double mean = 0;                                    // mean of the eigenvalues of |H|
};

struct LocalNewtonOptions {
  double max_move = .5;  // of a vertex, in its target lengths
  double over_relaxation = 1;
  int max_halvings = 5;  // of a move that breaks a guard or raises the energy, before the vertex stays
  double rest = 0;       // a vertex that wants to move less, in its target length, stays
};

/// Works on one vertex at a time; made once for many, for its memory. Keeps a reference to the relaxation.
class LocalNewton {
 public:
  explicit LocalNewton(Relaxation& relaxation);

  /// Eigenvalues count by their size, and those below a part of the largest are raised to it: the step
  /// -inverse * gradient descends from saddles too. None for a vertex that stands still.
  LocalCurvature curvature(int vertex);

  /// Moves the vertex to where its energy is least, as far as the guards let it; returns how far that was, in
  /// its target length.
  double improve(int vertex, const LocalNewtonOptions& options);

 private:
  /// The ring of one side of the vertex, where it is and where it is to go.
  struct Wedge {
    VertexRing ring;
    RingShape before, after;
  };

  bool look(int vertex);
  Mat32 directions(int vertex) const;
  bool may_move(const SurfacePosition& place);

  Relaxation& r_;
  Wedge wedge_, other_side_;
  bool two_wedges_ = false;
  Mat32 basis_ = Mat32::Zero();
  RingModel model_;
};

/// One sweep over all vertices; those with `active` false stay (empty: all move). Returns how far each
/// vertex moved, in its target length.
std::vector<double> local_newton_sweep(Relaxation& relaxation, const std::vector<char>& active,
                                       const LocalNewtonOptions& options);

// Newton's method vertex by vertex about some places of the mesh, where the rest is well as it is.

struct LocalRelaxationOptions {
  int sweeps = 8;
  double over_relaxation = 1;  // more is faster where vertices have far to go, but magnifies rounding
  double rest = 3e-3;          // of a target length; what moves less in a sweep sits out the next
};

struct LocalRelaxationResult {
  int sweeps = 0;
  bool interrupted = false;
};

/// Sweeps over the vertices until all are at rest or the sweeps are used up. Nothing else moves.
LocalRelaxationResult relax_locally(Relaxation& relaxation, const std::vector<int>& vertices,
                                    const LocalRelaxationOptions& options, const Observer& observer);

}  // namespace hooke
