// How much coarser than asked for a mesh may first be made.
#pragma once

#include <optional>

#include "hooke/connectivity/collapse_passes.h"
#include "hooke/connectivity/face_count.h"
#include "hooke/connectivity/flip_mode.h"
#include "hooke/connectivity/valence_flips.h"

namespace hooke {

struct WorkingMesh;

struct CoarseLimits {
  int levels = 1;           // times the target lengths are doubled, at most
  double min_faces = 80;    // of the coarsest mesh
  double sagitta = .07;     // greatest of an edge of the coarsest mesh over its length ...
  double bent_share = .01;  // ... but for this part of them
  double rim_share = .25;   // greatest part of the coarsest mesh's vertices that lie on curves or stand still
  // A mesh with no more irregular inner vertices and no more edges beyond these lengths, in parts of all, is
  // regular already: no coarser one comes first.
  double irregular_share = .1, misfit_share = .01;
  double shortest = .8, longest = 4. / 3;  // over the target lengths
};

/// How many times the target lengths can be doubled so that edges as long still follow the surface, judged by
/// how its normals turn along the edges there are; each stands for as many edges of the target length as
/// cover its square. None where there are creases: the narrow faces between them want the lengths that were
/// asked for. Pre-condition: the edges of the curves are counted.
int coarse_levels(const WorkingMesh& mesh, double wanted_faces, const CoarseLimits& limits);

// What the adaptation of a mesh is made of, step by step; their order is that of adaptation.h.

struct StepOptions {
  double chord_error = .1;  // greatest distance of a curve from its edges, in target lengths
  double keep_bends = 1.3;  // a curve keeps its bends if its edges and those it wants differ by less
  int spring_steps = 15;    // evaluations of the springs' energy before flips of irregular edges
  SplitOptions split;
  CollapseOptions collapse;
  CollapseOptions folded = folded_face_options();
  CountOptions count;
  FlipPassOptions irregular{
      .passes = 3, .rings = 3, .sweeps = 4, .max_energy_rise = .5, .max_rise_after_relaxation = .15};
};

struct StepCounts {
  long long splits = 0, collapses = 0, flips = 0;
};

// Adjacency mode `adapt`: edges are split and collapsed too, until there are as many faces of the target
// length as the surface takes. What follows is that of mode `flip`: see flip_connectivity.h.
// After M. Botsch and L. Kobbelt, "A remeshing approach to multiresolution modeling", 2004. Where the surface
// is smooth a coarser mesh is made first and every face of it becomes four: all new vertices are regular, so
// that few others are left.

struct AdaptOptions {
  int rounds = 5;          // of splits, collapses and flow
  int count_rounds = 30;   // of count control and flow, at most
  int first_flow = 6;      // rounds of flow before: what can stay where it spreads out need not go
  int flow_rounds = 6;     // after the splits and collapses of a round
  int count_flow = 6;      // rounds of flow after a round of count control
  double count_slack = 2;  // faces by which the count may miss what is wanted

  // With a coarser mesh first. The rounds are then those of the coarsest mesh, which is not flown before.
  CoarseLimits coarse;
  int coarse_flow = 6;                 // takes the place of flow_rounds
  int fine_rounds = 1;                 // of splits, collapses and flow at the target lengths ...
  int fine_flow = 6;                   // ... with so many rounds of flow
  double fine_count_slack = .01;       // part of the faces
  int last_flow = 3, last_passes = 2;  // what mode `flip` does then, at most, ...
  int last_outer = 6;                  // ... and so many outer iterations after it, if polish follows, ...
  std::optional<int> last_steps;       // ... each with so many evaluations of the energy by L-BFGS

  StepOptions steps;
};

/// The options that an effort stands for.
AdaptOptions adapt_options(Effort effort);

struct AdaptResult {
  UntangleResult untangle;
  int levels = 0;  // of coarser meshes: how many times the faces of the first became four
  int rounds = 0;
  int count_rounds = 0;
  long long splits = 0, collapses = 0, flips = 0;
  double wanted_faces = 0;
  bool interrupted = false;
};

/// Replaces the mesh of the work. Boundary loops, creases, corners and fixed vertices are kept, as is the
/// topology. Pre-condition: no refit() yet.
AdaptResult adapt(Workspace& work, const AdaptOptions& options, const FlipGuardOptions& flip_guard,
                  const EnergyTerms& terms, const GuardOptions& guards, double corner_angle,
                  const Observer& observer);

/// What mode `flip` is to do after that: less where most vertices are regular already.
FlipOptions flips_after(const AdaptResult& adapted, const AdaptOptions& options, FlipOptions flips);

}  // namespace hooke
