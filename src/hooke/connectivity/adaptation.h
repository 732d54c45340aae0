// Connectivity mode `adapt`: edges are split and collapsed as well as flipped, until the mesh has as many
// faces of the target length as the surface takes. Where the surface is smooth, a coarser mesh comes first
// and is refined by 1-to-4 subdivision, whose new vertices are all regular. After M. Botsch and L. Kobbelt,
// "A remeshing approach to multiresolution modeling", 2004.
#pragma once

#include <optional>

#include "hooke/connectivity/flip_mode.h"
#include "hooke/connectivity/valence_flips.h"

namespace hooke {

struct WorkingMesh;

/// Limits on how much coarser than requested the first mesh may be.
struct CoarseLimits {
  int levels = 1;                  // maximum number of times the target lengths are doubled
  double min_faces = 80;           // minimum number of faces of the coarsest mesh
  double sagitta = .07;            // maximum sagitta of an edge of the coarsest mesh, over its length
  double bent_share = .01;         // share of its edges that may exceed that sagitta
  double constrained_share = .25;  // maximum share of its vertices that are fixed or on feature curves
  // A mesh with at most these shares of irregular inner vertices, and of edges outside the range of lengths
  // below, is regular already and needs no coarser mesh first.
  double irregular_share = .1, misfit_share = .01;
  double shortest = .8, longest = 4. / 3;  // lengths, over the target lengths
};

/// Number of times the target lengths can be doubled while edges of that length still follow the surface.
/// This is estimated from the turn of the normals along the present edges, weighted by squared relative
/// length. Returns 0 for a mesh with creases: narrow faces between creases need the requested lengths.
/// Pre-condition: count_curve_edges().
int coarse_levels(const WorkingMesh& mesh, double target_faces, const CoarseLimits& limits);

/// Options of the single steps.
struct StepOptions {
  static constexpr double chord_error =
      .1;  // maximum distance of a feature curve from its edges, in target lengths
  static constexpr double keep_bends =
      1.3;  // maximum ratio of target to present edge count at which a curve keeps its bends
  static constexpr double resolve_bends =
      1.5;                // ratio of these from which on it keeps them too, and is split between them
  int spring_steps = 15;  // evaluations of the spring energy before flips of irregular edges
  FlipPassOptions irregular{
      .passes = 3, .rings = 3, .sweeps = 4, .max_energy_rise = .5, .max_rise_after_relaxation = .15};
};

struct StepCounts {
  long long splits = 0, collapses = 0, flips = 0;
};

/// Options of mode `adapt`; the steps of mode `flip` follow it, see flip_mode.h.
struct AdaptOptions {
  int rounds = 5;                          // of splits, collapses and Lloyd flow
  static constexpr int count_rounds = 30;  // maximum rounds of face count control and Lloyd flow
  int first_flow = 6;   // rounds of Lloyd flow before the first split; vertices that spread out can stay
  int flow_rounds = 6;  // of Lloyd flow after the splits and collapses of a round
  int count_flow = 6;   // rounds of Lloyd flow after a round of face count control
  static constexpr double count_slack = 2;  // faces by which the count may miss the target

  // With a coarser mesh first. `rounds` then applies to the coarsest mesh, without `first_flow`.
  CoarseLimits coarse;
  int coarse_flow = 6;                   // replaces flow_rounds and is the Lloyd flow of each coarser level
  static constexpr int fine_rounds = 1;  // of splits, collapses and Lloyd flow at the target lengths
  int fine_flow = 6;                     // rounds of Lloyd flow in each of the fine rounds
  static constexpr double fine_count_slack =
      .01;                             // share of the target face count by which the count may miss it
  int last_flow = 3, last_passes = 2;  // maximum rounds of flow and flip passes of mode `flip` afterwards
  int last_outer = 6;                  // maximum outer iterations afterwards, if angle optimisation follows
  /// Target lengths in narrow regions may be as short as this, in the unit of the points, 0: they are as
  /// given; and their growth away from these. See springs/narrow_regions.h.
  double min_length = 0, gradation = 0;
  std::optional<int> last_steps;  // maximum energy evaluations of L-BFGS in each of these iterations

  StepOptions steps;
};

/// The options for an effort level.
AdaptOptions adapt_options(Effort effort);

/// Replaces the mesh of the workspace. The topology, boundary loops, creases, corners and fixed vertices are
/// kept. Where vertices are held, as the mesh was adapted before, no coarser mesh comes first, and what is
/// known of bends, junctions and narrow regions stays. `corner_angle`: degrees, see corner_valences().
/// Pre-condition: the vertices are tracked on the field of the input.
AdaptResult adapt(Workspace& work, const AdaptOptions& options, const EnergyTerms& terms,
                  const ShapeLimits& limits, double corner_angle, const Observer& observer);

/// The options of mode `flip` after that: less is done if a coarser mesh came first, as most vertices are
/// then regular.
FlipOptions flips_after(const AdaptResult& adapted, const AdaptOptions& options, FlipOptions flips);

}  // namespace hooke
