#include "hooke/connectivity/flip_mode.h"

#include <algorithm>
#include <cmath>

#include "hooke/constraints/constraints.h"
#include "hooke/core/stopwatch.h"
#include "hooke/integrator/relaxation.h"
#include "hooke/integrator/untangle.h"
#include "hooke/mesh/halfedge_mesh.h"
#include "hooke/springs/energy.h"
#include "hooke/working_mesh/working_mesh.h"
#include "hooke/working_mesh/workspace.h"

namespace hooke {
namespace {

class FlipMode {
 public:
  FlipMode(Workspace& work, const FlipOptions& options, const EnergyTerms& terms, const ShapeLimits& limits,
           const Observer& observer)
      : work_(work), options_(options), terms_(terms), limits_(limits), observer_(observer) {
    work.set_corner_valences();
  }

  FlipResult run() {
    unfold();
    if (!result_.interrupted && options_.flow_rounds > 0) flow_vertices();
    flip_and_relax();
    for (int pass = 0; pass < options_.passes.passes && !result_.interrupted; ++pass)
      if (!improve_flips()) break;
    return result_;
  }

 private:
  /// Calls body(relaxation) with a relaxation for the present faces.
  template <typename Relax>
  auto relax(const Relax& body) {
    Relaxation r(work_, terms_, limits_);
    return body(r);
  }

  /// Calls body(mesh), which returns its number of flips, and writes changed faces to the workspace.
  template <typename Flips>
  long long flip(const Flips& body) {
    WorkingMesh m(work_);
    m.after_move = [this] { work_.resample_lengths(); };
    const long long flips = body(m);
    if (flips > 0) work_.replace_faces(m.halfedges.faces());
    result_.flips += flips;
    return flips;
  }

  Observer watch(const char* stage) const {
    if (!observer_) return nullptr;
    return [this, stage](Progress p) {
      p.stage = stage;
      return observer_(p);
    };
  }

  void unfold() {
    const UntangleResult unfolded = relax([&](Relaxation& r) { return untangle(r, watch("untangle")); });
    result_.folded_before = unfolded.folded_before;
    result_.interrupted = unfolded.interrupted;
  }

  void flow_vertices() {
    const Stage stage(work_.stopwatch, "flow");
    LloydFlowResult flowed;
    flip([&](WorkingMesh& m) {
      flowed = flow(m, options_.flow_rounds, limits_, observer_);
      return flowed.flips;
    });
    result_.flow_rounds = flowed.rounds;
    result_.interrupted = flowed.interrupted;
    note_limited_steps(flowed.limited_steps, flowed.rounds);
  }

  /// If guards limit many, Newton sweeps precede the next L-BFGS relaxation.
  void note_limited_steps(long long limited_steps, int steps) {
    constexpr double many = 2e-3;  // of the vertices, per step
    guard_limited_ = static_cast<double>(limited_steps) > many * work_.adjacency->vertex_count * steps;
  }

  /// Newton sweeps help vertices limited by guards; otherwise no slivers are left after the Lloyd flow.
  void relax_springs() {
    const Stage stage(work_.stopwatch, "springs");
    IntegrationOptions integration;
    integration.max_steps = options_.spring_steps;
    LbfgsOptions lbfgs;
    if (!guard_limited_) lbfgs.sweeps = 0;
    const IntegrationResult relaxed =
        relax([&](Relaxation& r) { return relax_lbfgs(r, integration, lbfgs, watch("springs")); });
    note_limited_steps(relaxed.limited_steps, relaxed.evaluations);
    work_.resample_lengths();
    result_.evaluations += relaxed.evaluations;
    result_.interrupted = relaxed.reason == StopReason::interrupted;
  }

  void flip_and_relax() {
    for (int round = 0; round < options_.spring_rounds && !result_.interrupted; ++round) {
      relax_springs();
      ++result_.spring_rounds;
      if (flip([&](WorkingMesh& m) { return flip_to_delaunay(m); }) <= few_flips()) break;
    }
  }

  long long few_flips() const {
    return static_cast<long long>(options_.few_flips * static_cast<double>(work_.adjacency->edges.size()));
  }

  bool improve_flips() {
    relax_springs();
    if (result_.interrupted) return false;
    ++result_.passes;
    const Stage stage(work_.stopwatch, "irregular");
    const Observer watching = [this, watched = watch("flips")](const Progress& p) {
      result_.interrupted = watched && !watched(p);
      return !result_.interrupted;
    };
    return flip([&](WorkingMesh& m) {
             return flip_irregular_edges(m, terms_, options_.passes, limits_, lately_changed_, watching);
           }) > 0;
  }

  Workspace& work_;
  const FlipOptions& options_;
  const EnergyTerms& terms_;
  const ShapeLimits& limits_;
  const Observer& observer_;
  std::vector<char> lately_changed_;  // per vertex: flag, by flips of irregular edges
  /// Did guards limit many steps of the flow or the last springs? True before both.
  bool guard_limited_ = true;
  FlipResult result_;
};

}  // namespace

FlipResult run_flip_mode(Workspace& work, const FlipOptions& options, const EnergyTerms& terms,
                         const ShapeLimits& limits, const Observer& observer) {
  return FlipMode(work, options, terms, limits, observer).run();
}

void measure_travel(const Workspace& work, FlipResult& result) {
  double sum2 = 0;
  for (Eigen::Index v = 0; v < work.start->cols(); ++v) {
    const double travel =
        (work.vertices.positions.points.col(v) - work.start->col(v)).norm() / work.vertices.vertex_length[v];
    result.max_travel = std::max(result.max_travel, travel);
    sum2 += travel * travel;
  }
  result.rms_travel = std::sqrt(sum2 / static_cast<double>(std::max<Eigen::Index>(work.start->cols(), 1)));
}

}  // namespace hooke
