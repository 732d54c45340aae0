#include "hooke/remesh/remesh.h"

#include <algorithm>
#include <chrono>

#include "hooke/remesh/outer_iterations.h"

namespace hooke {
namespace {

/// A coarser mesh was relaxed before: these vertices started where they are nearly at rest.
RemeshOptions relaxing_little(RemeshOptions options) {
  options.max_outer = std::min(options.max_outer, options.adaptation.last_outer);
  int& steps = options.integration.max_steps;
  if (options.integrator == IntegratorKind::lbfgs)
    steps = std::min(steps, options.adaptation.last_steps.value_or(steps));
  return options;
}

/// Slivers that are left get other edges. Returns whether there was any such change.
bool mend_once(Workspace& work, const RemeshOptions& options, const Observer& observer,
               RemeshResult& result) {
  const auto start = std::chrono::steady_clock::now();
  const Observer watch = [&](Progress p) {
    p.stage = "mend";
    if (observer && !observer(p)) result.reason = StopReason::interrupted;
    return result.reason != StopReason::interrupted;
  };
  const SliverChanges changes = timed(work.stopwatch, "mend", [&] {
    return mend_slivers(work, options.connectivity, {.altitude = options.altitude}, options.mend,
                        options.guards, options.constraints.corner_angle, watch);
  });
  result.sliver_tries += changes.tries;
  if (changes.count() == 0) return false;
  RemeshOptions rest = options;
  rest.search.sagitta = options.mend.trials.change.sagitta;
  const double before = result.iterations.empty() ? 0 : result.iterations.back().seconds;
  const std::chrono::duration<double> trials = std::chrono::steady_clock::now() - start;
  result = search_again(work, rest, std::move(result), before + trials.count(), observer);
  result.flips.flips += changes.flips;
  result.adaptation.splits += changes.splits;
  result.adaptation.collapses += changes.merges;
  return true;
}

void mend(Workspace& work, const RemeshOptions& options, const Observer& observer, RemeshResult& result) {
  bool changed = options.polish_angles;
  for (int pass = 0; changed && pass < options.mend.passes; ++pass)
    changed = result.reason != StopReason::interrupted && mend_once(work, options, observer, result);
}

}  // namespace

std::vector<int> faces_of_result(const Workspace& work, const std::vector<int>& faces) {
  std::vector<int> ids;
  for (int f : faces) ids.push_back(work.order.old_face[static_cast<size_t>(f)]);
  std::ranges::sort(ids);
  return ids;
}

RemeshResult remesh(TriMesh& mesh, const RemeshOptions& options, const Observer& observer,
                    Stopwatch* stopwatch) {
  return remesh(mesh, timed(stopwatch, "order", [&] { return lay_out(mesh); }), options, observer, stopwatch);
}

RemeshResult remesh(TriMesh& mesh, Layout layout, const RemeshOptions& options, const Observer& observer,
                    Stopwatch* stopwatch) {
  Workspace work(mesh, std::move(layout), options.constraints, options.filter, options.retraction,
                 options.guards, stopwatch);
  const EnergyTerms terms{.altitude = options.altitude};
  const double corner_angle = options.constraints.corner_angle;
  AdaptResult adapted;
  FlipResult flips;
  if (options.connectivity == ConnectivityMode::adapt)
    adapted = timed(stopwatch, "adapt", [&] {
      return adapt(work, options.adaptation, options.flips.guard, terms, options.guards, corner_angle,
                   observer);
    });
  flips.interrupted = adapted.interrupted;
  if (options.connectivity != ConnectivityMode::fixed && !flips.interrupted)
    flips = timed(stopwatch, "flip", [&] {
      const FlipOptions then = flips_after(adapted, options.adaptation, options.flips);
      return flip_connectivity(work, then, terms, options.guards, corner_angle, observer);
    });
  const bool near_regular = options.connectivity == ConnectivityMode::fixed && do_no_harm(work, options.harm);
  RemeshOptions then = options;
  if (adapted.levels > 0 && options.polish_angles) then = relaxing_little(std::move(then));
  RemeshResult result = iterate(work, then, flips, observer);
  result.near_regular = near_regular;
  result.adaptation = adapted;
  switch (options.connectivity) {
    case ConnectivityMode::fixed:
      break;
    case ConnectivityMode::flip:
      result.folded_before = flips.untangle.folded_before;
      mend(work, options, observer, result);
      measure_travel(work, result.flips);
      break;
    case ConnectivityMode::adapt:
      result.folded_before = adapted.untangle.folded_before;
      mend(work, options, observer, result);
      break;
  }
  if (options.map) result.map = work.map();
  result.input_points = work.copy_back(mesh);
  result.layout = work.layout();
  return result;
}

}  // namespace hooke
