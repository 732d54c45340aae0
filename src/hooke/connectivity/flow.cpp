#include "hooke/connectivity/flow.h"

#include "hooke/integrator/landing.h"
#include "hooke/mesh/creases.h"

namespace hooke {
namespace {

/// One guarded Lloyd step. Returns the number of vertices held back.
int move_vertices(FlippingMesh& m, const Connectivity& connectivity, const LloydOptions& options,
                  const GuardOptions& guard_options) {
  const TargetLengths targets = spread_target_lengths(connectivity, m.vertex_length);
  Mat3X step = lloyd_step(m.placement, connectivity, m.vertex_length, options);
  m.retraction.constrain(m.placement, step);
  cap_displacement(m.vertex_length, options.max_move, step);
  const Guards guards(connectivity, targets, guard_options);
  Placement moved;
  const auto held_back = guards.step(m.retraction, m.placement, step, moved).size();
  m.placement = std::move(moved);
  return static_cast<int>(held_back);
}

}  // namespace

FlowResult flow(FlippingMesh& m, const FlowOptions& options, const FlipGuardOptions& flip_guard,
                const GuardOptions& guards, const Observer& observer) {
  FlowResult result;
  result.interrupted = observer && !observer({.stage = "flow"});
  const auto connect = [&m] {
    Connectivity c = connectivity_of(m.triangulation, static_cast<int>(m.placement.points.cols()));
    part_at_creases(c, m.constraints.creases);
    return c;
  };
  Connectivity connectivity = connect();
  while (result.rounds < options.rounds && !result.interrupted) {
    int flips = flip_to_delaunay(m, flip_guard);
    if (result.rounds >= options.rounds / 4 && result.rounds % options.corner_every == 0)
      flips += force_corners(m, flip_guard);
    if (flips > 0) connectivity = connect();
    result.held_back += move_vertices(m, connectivity, options.lloyd, guards);
    if (m.after_move) m.after_move();
    result.flips += flips;
    ++result.rounds;
    result.interrupted = observer && !observer({.stage = "flow", .step = result.rounds});
  }
  const TargetLengths targets = spread_target_lengths(connectivity, m.vertex_length);
  settle(Guards(connectivity, targets, guards), m.retraction, m.placement);
  result.flips += flip_to_delaunay(m, flip_guard);
  return result;
}

}  // namespace hooke
