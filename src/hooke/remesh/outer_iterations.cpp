#include "hooke/remesh/outer_iterations.h"

#include <algorithm>
#include <chrono>

#include "hooke/core/error.h"
#include "hooke/integrator/landing.h"
#include "hooke/mesh/creases.h"

namespace hooke {
namespace {

/// The work in hand and the account of it.
class Remeshing {
 public:
  Remeshing(Workspace& work, const RemeshOptions& options, const Observer& observer)
      : options_(options),
        observer_(observer),
        work_(work),
        energy_(*work_.connectivity, work_.targets, {.altitude = options.altitude}),
        guards_(*work_.connectivity, work_.targets, work_.guards) {}

  RemeshResult run(const FlipResult& flips) {
    result_.flips = flips;
    if (flips.interrupted)
      stop(StopReason::interrupted);
    else
      unfold();
    for (int i = 0; !done_ && i < options_.max_outer; ++i) {
      ++outer_;
      iterate();
    }
    if (!interrupted() && options_.polish_angles)
      raise_angles();
    else if (outer_ == 0)
      settle_down();  // no iteration has
    conclude();
    return std::move(result_);
  }

  /// Other faces about the worst corners: these are searched again, for the `result` of a run so far, which
  /// has taken so long.
  RemeshResult search_again(RemeshResult result, double seconds) {
    result_ = std::move(result);
    seconds_before_ = seconds;
    if (interrupted())
      settle_down();
    else
      search();
    record("mend", {.energy = energy_(work_.placement, nullptr)});
    conclude();
    return std::move(result_);
  }

 private:
  Relaxation relaxation() {
    return {*work_.connectivity, work_.sweeps, work_.vertex_length, energy_,
            *work_.retraction,   guards_,      work_.placement,     work_.stopwatch};
  }

  Observer watch(const char* stage) const {
    if (!observer_) return nullptr;
    return [this, stage](Progress p) {
      p.stage = stage;
      p.outer = outer_;
      return observer_(p);
    };
  }

  bool interrupted() const { return result_.reason == StopReason::interrupted; }

  void unfold() {
    const Stage stage(work_.stopwatch, "untangle");
    Relaxation r = relaxation();
    const UntangleResult unfolded = untangle(r, options_.untangle, watch("untangle"));
    result_.folded_before = unfolded.folded_before;
    if (unfolded.interrupted) stop(StopReason::interrupted);
    if (unfolded.sweeps > 0) record("untangle", {.steps = unfolded.sweeps});
  }

  /// The sweeps take out slivers, of which hardly any are left after flow, or after an iteration that no
  /// guard held back.
  LbfgsOptions lbfgs() const {
    LbfgsOptions lbfgs = options_.lbfgs;
    const bool flowed = options_.connectivity != ConnectivityMode::fixed;
    if (flowed || !held_back_) lbfgs.sweeps = std::min(lbfgs.sweeps, 1);
    lbfgs.settles = !goes_on();
    return lbfgs;
  }

  IntegrationOptions integration() const {
    IntegrationOptions integration = options_.integration;
    if (options_.connectivity != ConnectivityMode::fixed)
      integration.energy_drop = options_.flips.energy_drop;
    return integration;
  }

  IntegrationResult relax() {
    Relaxation r = relaxation();
    switch (options_.integrator) {
      case IntegratorKind::lbfgs:
        return relax_lbfgs(r, integration(), lbfgs(), watch("relax"));
      case IntegratorKind::damped: {
        TriMesh moving = build_mesh(work_.placement.points, *work_.connectivity);
        return relax_damped(r, moving, integration(), options_.damped, watch("relax"));
      }
    }
    throw Error("unknown integrator");
  }

  /// A coarser mesh knows less of the surface than the input does.
  bool refits() const {
    return options_.refit == Refit::each && options_.connectivity != ConnectivityMode::adapt && !unhindered_;
  }

  /// Came to rest where the guards had next to nothing to hold back: there the surface is smooth under the
  /// mesh. A field fitted to vertices on it is the same surface again, and the minimum the same, unless the
  /// vertices have come to places with other target lengths.
  bool is_unhindered(const IntegrationResult& relaxed) const {
    const double vertex_steps = static_cast<double>(relaxed.evaluations) * work_.connectivity->vertex_count;
    return options_.integrator == IntegratorKind::lbfgs && !work_.graded() &&
           relaxed.reason == StopReason::stalled &&
           static_cast<double>(relaxed.held_back) <= options_.hindered * vertex_steps;
  }

  /// The next iteration or the polish goes on from where the vertices are, on the same field.
  bool goes_on() const {
    return options_.polish_angles && (unhindered_ || options_.connectivity == ConnectivityMode::adapt);
  }

  void iterate() {
    const Stage stage(work_.stopwatch, "relax");
    if (refits() && outer_ > 1) work_.refit();
    const double energy = energy_(work_.placement, nullptr);
    IntegrationResult relaxed = relax();
    held_back_ = relaxed.held_back > 0;
    unhindered_ = is_unhindered(relaxed);
    if (!goes_on() || relaxed.reason == StopReason::interrupted) {
      settle_down();
      if (work_.took_back()) relaxed.energy = energy_(work_.placement, nullptr);
    } else {
      work_.resample_lengths();
    }
    record("relax", relaxed, outer_);
    if (result_.iterations.back().max_length_error < options_.tolerance) return stop(StopReason::converged);
    if (relaxed.reason == StopReason::interrupted) return stop(StopReason::interrupted);
    if (relaxed.reason == StopReason::jammed && relaxed.steps == 0) return stop(StopReason::jammed);
    if (unhindered_ || energy - relaxed.energy <= options_.outer_drop * energy)
      return stop(StopReason::stalled);
    result_.reason = StopReason::step_limit;
  }

  void raise_angles() {
    const Stage stage(work_.stopwatch, "polish");
    if (refits()) work_.refit();
    {
      Relaxation r = relaxation();
      const PolishOptions& options =
          options_.connectivity == ConnectivityMode::fixed ? options_.polish : options_.flips.polish;
      result_.polish = polish(r, work_.targets, options, watch("polish"));
    }
    if (result_.polish.interrupted) {
      result_.reason = StopReason::interrupted;
      settle_down();
    } else {
      search();
    }
    record("polish", {.steps = result_.polish.sweeps, .energy = energy_(work_.placement, nullptr)});
  }

  /// On the field fitted last, where vertices can move that will not land; then, where landing has changed
  /// what is worst, on that of the input.
  void search() {
    if (work_.refitted()) {
      settle(guards_, *work_.retraction, work_.placement);
      search_here();
    }
    settle_down();
    work_.return_to_input();
    result_.not_landed = work_.land(search_here());
    work_.resample_lengths();
  }

  /// Returns the vertices that may have moved.
  std::vector<int> search_here() {
    return timed(work_.stopwatch, "search", [&] {
      Relaxation r = relaxation();
      return search_angles(r, options_.search).vertices;
    });
  }

  void settle_down() {
    result_.not_landed = work_.land();
    work_.resample_lengths();
  }

  void conclude() {
    result_.folded_faces = faces_of_result(work_, guards_.folded_faces(work_.placement));
    result_.holds = holds_of_result(work_, guards_, options_.constraints);
    result_.creases = count_creases(work_);
    result_.crease_edges = crease_edges(*work_.connectivity);
    for (Edge& e : result_.crease_edges)
      for (int& v : e) v = work_.order.old_vertex[static_cast<size_t>(v)];
    result_.projection = work_.projection_counts();
  }

  void stop(StopReason reason) {
    result_.reason = reason;
    done_ = true;
  }

  void record(const char* stage, const IntegrationResult& done, int outer = 0) {
    IterationRecord record = iteration_record(work_, stage, done);
    record.outer = outer;
    record.seconds =
        seconds_before_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    result_.iterations.push_back(record);
    result_.held_back += done.held_back;
  }

  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  const RemeshOptions& options_;
  const Observer& observer_;
  Workspace& work_;
  Energy energy_;
  Guards guards_;
  RemeshResult result_;
  double seconds_before_ = 0;
  int outer_ = 0;
  bool held_back_ = true;  // by the guards, in the last relaxation
  bool unhindered_ = false;
  bool done_ = false;
};

}  // namespace

RemeshResult iterate(Workspace& work, const RemeshOptions& options, const FlipResult& flips,
                     const Observer& observer) {
  return Remeshing(work, options, observer).run(flips);
}

RemeshResult search_again(Workspace& work, const RemeshOptions& options, RemeshResult result, double seconds,
                          const Observer& observer) {
  return Remeshing(work, options, observer).search_again(std::move(result), seconds);
}

}  // namespace hooke
