// What the adaptation of a mesh is made of, step by step; their order is that of adaptation.h.
#pragma once

#include "hooke/connectivity/coarse_levels.h"
#include "hooke/connectivity/count_control.h"
#include "hooke/connectivity/face_collapses.h"
#include "hooke/connectivity/flip_pass.h"
#include "hooke/working_mesh/adapting_work.h"

namespace hooke {

struct StepOptions {
  double chord_error = .1;  // greatest distance of a curve from its edges, in target lengths
  double keep_bends = 1.3;  // a curve keeps its bends if its edges and those it wants differ by less
  int spring_steps = 15;    // evaluations of the springs' energy before flips of irregular edges
  SplitOptions split;
  CollapseOptions collapse;
  CollapseOptions folded = folded_face_options();
  CountOptions count;
  FlipPassOptions irregular{.passes = 3, .rings = 3, .sweeps = 4, .hope = .5, .swept_hope = .15};
};

struct StepCounts {
  long long splits = 0, collapses = 0, flips = 0;
};

/// All leave a mesh of the same topology, with its boundary loops, creases, corners and fixed vertices. Keeps
/// references to what it is given. After finish() nothing more may be called.
class AdaptationSteps {
 public:
  /// `corner_angle`: degrees, see corner_rule.h. The observer is asked as by the steps that take one.
  AdaptationSteps(Workspace& work, const StepOptions& options, const FlipGuardOptions& flip_guard,
                  const EnergyTerms& terms, const GuardOptions& guards, double corner_angle,
                  Observer observer);

  /// Vertices at bends may move and go where a curve is to have other edges.
  void release_bends();

  /// Doubles the target lengths so many times; below zero they are halved.
  void coarsen(int levels);

  /// How often they may be doubled.
  int bearable_levels(double wanted_faces, const CoarseLimits& limits) const;

  /// Splits and collapses edges that are too long or too short, and gives curves as many as they want.
  void change_lengths();

  /// Brings the number of faces closer to what is wanted; false if nothing changes it.
  bool change_count(double wanted_faces);

  /// Flow, after which the mesh is Delaunay and its vertices lie on the surface, as far as guards let them.
  void settle(int rounds);

  /// Passes of springs and flips about irregular vertices, until one flips nothing.
  void flip_irregular();

  /// Every face becomes four.
  void quadruple();

  /// Gives the work the mesh as it is now.
  void finish() { adapting_.replace_mesh(); }

  double face_count() const { return static_cast<double>(m_.triangulation.faces().size()); }
  const StepCounts& counts() const { return counts_; }
  bool interrupted() const { return interrupted_; }

 private:
  void give_up_unused_ids();
  void settle_springs();
  int pass_over_irregular(std::vector<char>& lately_changed);
  void resample_lengths();
  void add(const CountChanges& changes);

  Workspace& work_;
  const StepOptions& options_;
  const FlipGuardOptions& flip_guard_;
  const EnergyTerms& terms_;
  const GuardOptions& guards_;
  const Observer observer_;
  AdaptingWork adapting_;
  AdaptingMesh& m_ = adapting_.mesh();
  const bool graded_;
  int level_ = 0;  // the target lengths are doubled so many times
  StepCounts counts_;
  bool interrupted_ = false;
};

}  // namespace hooke
