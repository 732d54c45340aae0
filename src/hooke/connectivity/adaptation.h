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
  /// A mesh with at most this share of irregular inner vertices, of whose edges at most 1 % are shorter than
  /// .8 or longer than 4/3 target lengths, is regular already and needs no coarser mesh first.
  double irregular_share = .1;
};

/// Number of times the target lengths can be doubled while edges of that length still follow the surface.
/// This is estimated from the turn of the normals along the present edges, weighted by squared relative
/// length. Returns 0 for a mesh with creases: narrow faces between creases need the requested lengths.
/// Pre-condition: count_curve_edges().
int coarse_levels(const WorkingMesh& mesh, double target_faces, const CoarseLimits& limits);

/// Options of mode `adapt`; the steps of mode `flip` follow it, see flip_mode.h.
struct AdaptOptions {
  int rounds = 5;       // of splits, collapses and Lloyd flow
  int first_flow = 6;   // rounds of Lloyd flow before the first split; vertices that spread out can stay
  int flow_rounds = 6;  // of Lloyd flow after the splits and collapses of a round
  int count_flow = 6;   // rounds of Lloyd flow after a round of face count control

  // With a coarser mesh first. `rounds` then applies to the coarsest mesh, without `first_flow`.
  CoarseLimits coarse;
  int coarse_flow = 6;    // replaces flow_rounds and is the Lloyd flow of each coarser level
  int spring_steps = 15;  // evaluations of the spring energy before flips of irregular edges
  FlipPassOptions irregular{
      .passes = 3, .rings = 3, .sweeps = 4, .max_energy_rise = .5, .max_rise_after_relaxation = .15};
  int fine_flow = 6;                   // rounds of Lloyd flow at the target lengths
  int last_flow = 3, last_passes = 2;  // maximum rounds of flow and flip passes of mode `flip` afterwards
  int last_outer = 6;                  // maximum outer iterations afterwards, if angle optimisation follows
  /// Target lengths in narrow regions may be as short as this, in the unit of the points, 0: they are as
  /// given; and their growth away from these. See springs/narrow_regions.h.
  double min_length = 0, gradation = 0;
  std::optional<int> last_steps;  // maximum energy evaluations of L-BFGS in each of these iterations
};

/// Replaces the mesh of the workspace. The topology, boundary loops, creases, corners and fixed vertices are
/// kept. Where vertices are held, as the mesh was adapted before, no coarser mesh comes first, and what is
/// known of bends, junctions and narrow regions stays.
/// Pre-condition: the vertices are tracked on the field of the input.
AdaptResult adapt(Workspace& work, const AdaptOptions& options, const EnergyTerms& terms,
                  const ShapeLimits& limits, const Observer& observer);

/// The options of mode `flip` after that: less is done if a coarser mesh came first, as most vertices are
/// then regular.
FlipOptions flips_after(const AdaptResult& adapted, const AdaptOptions& options, FlipOptions flips);

}  // namespace hooke
