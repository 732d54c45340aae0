#include "hooke/remesh/paper_mode.h"

#include <algorithm>
#include <chrono>
#include <numeric>

#include "hooke/filter/retraction.h"
#include "hooke/integrator/guards.h"
#include "hooke/mesh/mesh.h"
#include "hooke/remesh/remesh.h"
#include "hooke/springs/forces.h"
#include "hooke/working_mesh/workspace.h"

namespace hooke {
namespace {

/// Within the tolerance a time step is filtered by the second-order shape of psi, without evaluating it.
constexpr RetractionOptions retraction_of_paper = {.tolerance = 1e-5, .lazy = .1, .lazy_error = 1e-5};

/// A run of Algorithm 1.
class PaperRun {
 public:
  PaperRun(const TriMesh& mesh, MemoryOrder memory_order, const PaperOptions& options,
           const Observer& observer)
      : options_(options),
        observer_(observer),
        work_(mesh, std::move(memory_order), options.constraints, options.filter, retraction_of_paper),
        mesh_(build_mesh(*work_.start, *work_.adjacency)) {
    for (JunctionVertex& v : work_.vertices.constraints.junction_vertices) v.slides = false;
  }

  RemeshResult run(TriMesh& mesh) {
    const Guards guards(*work_.adjacency, work_.targets, {});
    result_.folded_before = static_cast<int>(guards.folded_faces(work_.vertices.positions).size());
    result_.reason = StopReason::step_limit;
    for (outer_ = 1; !done_ && outer_ <= options_.max_outer; ++outer_) iterate();
    result_.projection = work_.projection_counts();
    result_.input_points = work_.copy_back(mesh);
    result_.memory_order = work_.memory_order();
    set_vertex_vectors(mesh, velocity_property,
                       result_.memory_order.order.scatter(motion_of(mesh_).velocities));
    set_residual_forces(mesh, result_.memory_order, options_.evolution.altitude);
    return std::move(result_);
  }

 private:
  void iterate() {
    if (outer_ > 1 && options_.refit == Refit::each) work_.refit();  // psi of M_t
    const double before = energy();
    EvolutionResult evolved = optimize();  // M_{t+1}
    filter();                              // M*_{t+1}
    evolved.energy = energy();
    record(evolved);
    const double worst = max_length_error(work_.vertices.positions.points, *work_.adjacency,
                                          work_.targets.edge.values());  // D
    if (worst < options_.evolution.tolerance) return stop(StopReason::converged);
    if (evolved.reason == StopReason::interrupted) return stop(StopReason::interrupted);
    if (before - evolved.energy > options_.outer_drop * before) return;
    stop(is_jammed(evolved) ? StopReason::jammed : StopReason::stalled);
  }

  double energy() const {
    return string_energy(work_.vertices.positions.points, *work_.adjacency, work_.targets.edge.values());
  }

  /// No time step was accepted, or they are so short that strong forces no longer move the mesh.
  bool is_jammed(const EvolutionResult& evolved) const {
    constexpr double strong = 2;  // over that of a string stretched by its rest length
    return evolved.reason == StopReason::jammed ||
           (!evolved.time_steps.empty() &&
            evolved.time_steps.back().max_force > strong * options_.evolution.damped.string);
  }

  EvolutionResult optimize() {
    const EvolutionSurface surface{
        .restrain = boundary_rule(),
        .positions = &work_.vertices.positions,
        .filter = options_.filter_every == FilterEvery::step ? work_.retraction.get() : nullptr};
    return evolve_damped(mesh_, *work_.adjacency, work_.targets.edge.values(), options_.evolution, watch(),
                         surface);
  }

  void filter() {
    SurfacePositions& p = work_.vertices.positions;
    p = work_.retraction->project_all(vertex_points(mesh_), std::move(p.hints), std::move(p.segments));
    vertex_points(mesh_) = p.points;
  }

  /// Restricts the forces on curve and fixed vertices, if the options have any, beyond the paper. All other
  /// vertices move freely in space, as in the paper.
  std::function<void(Mat3X& forces)> boundary_rule() const {
    const bool all_free = std::ranges::all_of(work_.vertices.constraints.freedom,
                                              [](Freedom f) { return f == Freedom::surface; });
    if (all_free) return nullptr;
    return [this](Mat3X& forces) {
      for (Eigen::Index v = 0; v < forces.cols(); ++v) {
        const Freedom freedom = work_.vertices.constraints.freedom[v];
        if (freedom == Freedom::surface) continue;
        const Vec3 tangent =
            work_.retraction->tangent(work_.vertices.positions, static_cast<int>(v));  // zero if fixed
        forces.col(v) = (tangent * tangent.dot(forces.col(v))).eval();
      }
    };
  }

  Observer watch() const {
    if (!observer_) return nullptr;
    return [this](Progress p) {
      p.stage = "paper";
      p.outer = outer_;
      return observer_(p);
    };
  }

  void record(const EvolutionResult& evolved) {
    IterationRecord record = iteration_record(work_, "paper", evolved);
    record.outer = outer_;
    record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    result_.iterations.push_back(record);
    for (TimeStepRecord step : evolved.time_steps) {
      step.outer = outer_;
      result_.time_steps.push_back(step);
    }
    result_.bound += evolved.bound;
    result_.jam = evolved.jam;
  }

  void stop(StopReason reason) {
    result_.reason = reason;
    done_ = true;
  }

  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  const PaperOptions& options_;
  const Observer& observer_;
  Workspace work_;
  TriMesh mesh_;  // with the moving vertices
  RemeshResult result_;
  int outer_ = 0;
  bool done_ = false;
};

}  // namespace

RemeshResult paper_remesh(TriMesh& mesh, const PaperOptions& options, const Observer& observer) {
  return paper_remesh(mesh, find_memory_order(mesh), options, observer);
}

RemeshResult paper_remesh(TriMesh& mesh, MemoryOrder memory_order, const PaperOptions& options,
                          const Observer& observer) {
  return PaperRun(mesh, std::move(memory_order), options, observer).run(mesh);
}

}  // namespace hooke
