// Newton's method vertex by vertex (nonlinear Gauss-Seidel): each vertex in turn moves toward the minimum of
// the energy around it, in its tangent plane and within the guards. Sweeps cover all vertices, or only some
// regions that need local relaxation.
#pragma once

#include <span>

#include "hooke/integrator/relaxation.h"
#include "hooke/integrator/vertex_ring.h"

namespace hooke {

using Mat32 = Eigen::Matrix<double, 3, 2>;

/// The Hessian of the energy around one vertex in the directions in which the vertex may move.
struct LocalCurvature {
  Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();  // |H|^-1 in the tangent space, zero across it
  double mean = 0;                                    // mean of the eigenvalues of |H|
};

struct LocalNewtonOptions {
  double max_move = .5;  // of a vertex, in its target lengths
  double over_relaxation = 1;
  static constexpr int max_halvings = 5;  // of a step that breaks a guard or raises the energy
  double rest = 0;                        // in target lengths; a vertex with a shorter step stays
  bool skips_middle_steps = false;        // try only the longest and the shortest
};

/// Works on one vertex at a time; reused for many vertices to save allocations. Keeps a reference to the
/// relaxation.
class LocalNewton {
 public:
  explicit LocalNewton(Relaxation& relaxation);

  /// Eigenvalues count by their absolute value, and those below a part of the largest are raised to it, so
  /// that the step -inverse * gradient also descends from saddles. Zero for a fixed vertex.
  LocalCurvature curvature(int vertex);

  /// The same of copies of a junction vertex that slide together, for each: the mean of theirs.
  LocalCurvature curvature(std::span<const int> copies);

  /// Moves the vertex toward the minimum of its energy, within the guards; returns the distance moved in its
  /// target lengths.
  double improve(int vertex, const LocalNewtonOptions& options);

  /// The same for copies of a junction vertex that slide together, by the energy around all of them.
  double improve(std::span<const int> copies, const LocalNewtonOptions& options);

  /// Were all steps that improve() tried last refused? False if it tried none.
  bool was_refused() const { return was_refused_; }

 private:
  /// The ring of one wedge of the vertex, at the current position and at the candidate.
  struct Wedge {
    VertexRing ring;
    RingShape before, after;
  };

  void gather(std::span<const int> copies);
  Mat32 directions(int vertex) const;
  bool may_move(std::span<const SurfacePosition> candidates);
  bool stays(int vertex) const;

  Relaxation& r_;
  std::vector<Wedge> wedges_;  // the first `count_` are in use
  std::size_t count_ = 0;
  std::vector<SurfacePosition> candidates_;
  Mat32 basis_ = Mat32::Zero();
  RingModel model_;
  bool was_refused_ = false;
};

/// One sweep over all vertices, then over those of junctions that slide with their copies; those with
/// `active` false stay (empty: all move), but for copies of one that moves. Returns the distance each vertex
/// moved, in its target lengths.
std::vector<double> local_newton_sweep(Relaxation& relaxation, const std::vector<char>& active,
                                       const LocalNewtonOptions& options);

struct LocalRelaxationOptions {
  int sweeps = 8;
  double over_relaxation = 1;  // above 1: faster where vertices move far, but magnifies rounding
  double rest = 3e-3;          // in target lengths; a vertex that moves less skips the next sweep
  bool slides_copies = true;   // of junction vertices, together; else these stay
};

struct LocalRelaxationResult {
  int sweeps = 0;
  int moves = 0;  // by more than `rest`
  bool interrupted = false;
};

/// Sweeps over `vertices`, each named once, until all are at rest or the sweeps are used up. No other vertex
/// moves, but for copies that slide with one of them.
LocalRelaxationResult relax_locally(Relaxation& relaxation, std::vector<int> vertices,
                                    const LocalRelaxationOptions& options, const Observer& observer);

}  // namespace hooke
