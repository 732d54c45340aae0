// What a mesh that is good already must not lose. Equal edges and great angles are two aims: a mesh whose
// angles are all good could pay for the one with the other.
#pragma once

#include "hooke/connectivity/adaptation.h"
#include "hooke/connectivity/flip_mode.h"
#include "hooke/connectivity/sliver_removal.h"
#include "hooke/filter/retraction.h"
#include "hooke/integrator/angle_search.h"
#include "hooke/integrator/angle_springs.h"
#include "hooke/integrator/damped_evolution.h"
#include "hooke/integrator/guards.h"
#include "hooke/integrator/lbfgs.h"
#include "hooke/integrator/untangle.h"
#include "hooke/remesh/limiting_factors.h"
#include "hooke/remesh/result.h"
#include "hooke/working_mesh/workspace.h"

namespace hooke {

struct HarmOptions {
  double angle = 35;       // degrees; a mesh is near-regular if no angle is below ...
  double deviation = .25;  // ... and the standard deviation of l / L_e is at most this part of its mean
  double reach = .19;      // of its target length, that a vertex of a near-regular mesh may travel
};

/// Lets the guards keep the least angle where all edges are to have one length or the mesh is near-regular,
/// and the vertices of a near-regular mesh within reach. Returns whether it is near-regular. Pre-condition:
/// no vertex has moved.
bool do_no_harm(Workspace& work, const HarmOptions& options, GuardOptions& guards);

// Filtered Hooke's Optimization, Algorithm 1: relaxation and filtering by turns until the mesh is regular.
// "Hooke's Optimization for 3D triangular mesh".

enum class Refit { each, once };

/// What brings the springs to their equilibrium; untangling and polishing go vertex by vertex.
enum class IntegratorKind {
  lbfgs,   // minimises the energy
  damped,  // follows the evolution [17], torque included
};

struct RemeshOptions {
  ConnectivityMode connectivity = ConnectivityMode::fixed;
  FlipOptions flips = flip_options(Effort::standard);  // in the modes `flip` and `adapt`
  AdaptOptions adaptation;                             // in mode `adapt`
  bool map = false;                                    // RemeshResult::map is wanted
  IntegratorKind integrator = IntegratorKind::lbfgs;
  IntegrationOptions integration{.energy_drop = 4e-3};  // its energy_drop is that of mode `fixed`
  LbfgsOptions lbfgs;
  DampedOptions damped;
  double altitude = 1;  // beta, weight of the altitude springs against the strings
  GuardOptions guards;
  HarmOptions harm;  // in mode `fixed`
  UntangleOptions untangle;
  PolishOptions polish;
  bool polish_angles = true;
  AngleSearchOptions search;  // after the polish
  MendOptions mend;           // after that, in the modes `flip` and `adapt`
  FilterOptions filter{.reach = .35};
  // Of the field: before each outer iteration, where the guards hindered the last; or once, which `adapt`
  // always does.
  Refit refit = Refit::each;
  RetractionOptions retraction{.tolerance = 1e-5, .lazy = 2};
  ConstraintOptions constraints;
  double tolerance = 1e-3;   // of every edge, in parts of its target length
  int max_outer = 6;         // outer iterations
  double outer_drop = 5e-3;  // stalled when an outer iteration lowers the energy by less than this part ...
  /// ... or comes to rest where guards held back no more of the vertices' steps than this part, all trials
  /// counted.
  double hindered = 2.5e-4;
};

struct RemeshResult {
  StopReason reason = StopReason::stalled;
  int attempts = 1;      // of which this is the best, see attempts.h ...
  int kept_attempt = 1;  // ... by its number
  int sliver_tries = 0;  // see sliver_trials.h
  std::vector<IterationRecord> iterations;
  Mat3X input_points;         // of the mesh as it was, to measure the result against
  Layout layout;              // of the mesh as it is now
  bool near_regular = false;  // in mode `fixed`: see do_no_harm.h
  int folded_before = 0;
  std::vector<int> folded_faces;  // still folded away from the surface, ids of the result
  CreaseCounts creases;
  std::vector<Edge> crease_edges;    // ids of the result
  FlipResult flips;                  // in the modes `flip` and `adapt`
  AdaptResult adaptation;            // in mode `adapt`
  std::vector<MapEntry> map;         // per vertex of the result
  std::vector<unsigned char> holds;  // per vertex of the result, see hindrances.h
  int not_landed = 0;  // vertices that stay off the input's field, where landing would fold a face
  PolishResult polish;
  ProjectionCounts projection;
  long long held_back = 0;  // vertex steps shortened by the guards
  BoundCounts bound;        // time steps by the test that set them (paper_remesh only)
  FailedTests jam;          // what no time step passed, when jammed there
};

/// Moves the vertices of the mesh on its own surface until its edges are as near to their target lengths
/// (v:target_length) as the connectivity allows, then raises its least angles. Ids stay, and in mode `fixed`
/// connectivity; in mode `flip` the mesh gets new faces, of as many ids, and its vertices may travel far from
/// where they were. In mode `adapt` it gets other vertices too: first those that are left of its own, in
/// their order, then new ones. The mesh is always left valid; an observer that returns false stops with what
/// has been reached.
RemeshResult remesh(TriMesh& mesh, const RemeshOptions& options, const Observer& observer = nullptr,
                    Stopwatch* stopwatch = nullptr);

/// The same with the mesh's layout, where it is known already.
RemeshResult remesh(TriMesh& mesh, Layout layout, const RemeshOptions& options,
                    const Observer& observer = nullptr, Stopwatch* stopwatch = nullptr);

}  // namespace hooke
