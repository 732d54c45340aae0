#include "hooke/remesh/run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "hooke/connectivity/adaptation.h"
#include "hooke/connectivity/face_count.h"
#include "hooke/connectivity/flip_mode.h"
#include "hooke/connectivity/sliver_removal.h"
#include "hooke/core/error.h"
#include "hooke/core/stopwatch.h"
#include "hooke/core/uniform_vector.h"
#include "hooke/geometry/triangle.h"
#include "hooke/integrator/damped_evolution.h"
#include "hooke/integrator/final_projection.h"
#include "hooke/integrator/guards.h"
#include "hooke/integrator/lbfgs.h"
#include "hooke/integrator/relaxation.h"
#include "hooke/integrator/untangle.h"
#include "hooke/mesh/mesh.h"
#include "hooke/mesh/normals.h"
#include "hooke/mesh/wedges.h"
#include "hooke/remesh/limiting_factors.h"
#include "hooke/remesh/remesh.h"
#include "hooke/remesh/run_options.h"
#include "hooke/springs/energy.h"
#include "hooke/springs/sizing.h"
#include "hooke/springs/target_lengths.h"
#include "hooke/working_mesh/workspace.h"

namespace hooke {
namespace {

/// Standard deviation of l / L_e over its mean.
double spread_of_edges(const Workspace& work) {
  const auto& edges = work.adjacency->edges;
  double sum = 0, squares = 0;
  for (size_t e = 0; e < edges.size(); ++e) {
    const auto [a, b] = edges[e];
    const double l = (work.start->col(a) - work.start->col(b)).norm() / work.targets.edge[e];
    sum += l;
    squares += l * l;
  }
  const double n = static_cast<double>(edges.size()), mean = sum / n;
  return std::sqrt(std::max(0., squares / n - mean * mean)) / mean;
}

/// Makes the limits preserve the minimum angle if the mesh is near-regular or has a uniform target length,
/// and limits the travel of the vertices of a near-regular mesh. Returns whether the mesh is near-regular.
/// Pre-condition: no vertex has moved.
bool keep_near_regular(Workspace& work, ShapeLimits& limits) {
  const double deviation =
      work.has_rest_ratios() ? NearRegular::deviation_of_squares : NearRegular::deviation;
  const bool near_regular = min_angle(*work.start, work.adjacency->faces) >= NearRegular::angle &&
                            spread_of_edges(work) <= deviation;
  if (near_regular || !work.has_varying_lengths())
    limits.cotangent = cotangent_limit(work.vertices.positions.points, work.adjacency->faces);
  if (work.has_rest_ratios())
    limits.cotangent = std::max(
        limits.cotangent,
        cotangent_of(NearRegular::share_of_rest_angle * least_rest_angle(*work.adjacency, work.targets)));
  if (near_regular) {
    work.vertices.constraints.rest_position = *work.start;
    for (double length : work.vertices.vertex_length)
      work.vertices.constraints.max_travel.push_back(NearRegular::max_travel * length);
  }
  return near_regular;
}

/// The common last part of all connectivity modes, with fixed faces: unfolds the mesh, alternates relaxation
/// and projection to the surface until the vertices are at rest, then raises the minimum angles. In the end
/// the vertices are projected to the field of the input, even if interrupted.
class OuterIterations {
 public:
  OuterIterations(Workspace& work, const RunOptions& options, const Observer& observer)
      : options_(options),
        observer_(observer),
        work_(work),
        guards_(*work_.adjacency, work_.targets, options.limits),
        projection_(work, options.limits) {}

  /// `flips`: the result of the connectivity mode; if it was interrupted, vertices are only projected.
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
    if (!interrupted() && polishes())
      raise_angles();
    else if (outer_ == 0)
      project_to_input();  // no iteration has done so
    return std::move(result_);
  }

  /// The last velocities of the damped integrator, in mean target lengths, 3 x |V| in memory order; 3 x 0
  /// with the other one.
  Mat3X velocities() {
    if (moving_.n_vertices() == 0) return Mat3X(3, 0);
    return motion_of(moving_).velocities;
  }

  /// Searches the angles again after edges near slivers have changed. `result`: of the run so far, which took
  /// `seconds`.
  RemeshResult search_again(RemeshResult result, double seconds) {
    result_ = std::move(result);
    seconds_before_ = seconds;
    if (interrupted())
      project_to_input();
    else
      search();
    record("mend", {.energy = present_energy()});
    return std::move(result_);
  }

 private:
  /// On the field fitted last.
  Relaxation relaxation() { return {work_, {.altitude = options_.chosen.altitude}, options_.limits}; }

  double present_energy() { return relaxation().present_energy(); }

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
    const UntangleResult unfolded = untangle(r, watch("untangle"));
    result_.folded_before = unfolded.folded_before;
    if (unfolded.interrupted) stop(StopReason::interrupted);
    if (unfolded.sweeps > 0) record("untangle", {.steps = unfolded.sweeps});
  }

  /// Newton sweeps remove slivers. Hardly any are left after Lloyd flow or an iteration without limiting
  /// guards.
  LbfgsOptions lbfgs() const {
    LbfgsOptions lbfgs;
    const bool flowed = options_.chosen.connectivity != ConnectivityMode::fixed;
    if (flowed || !guard_limited_) lbfgs.sweeps = std::min(lbfgs.sweeps, 1);
    lbfgs.projects_at_end = !goes_on();
    return lbfgs;
  }

  IntegrationOptions integration() const {
    IntegrationOptions integration = options_.integration;
    if (options_.chosen.connectivity != ConnectivityMode::fixed)
      integration.energy_drop = options_.flips.energy_drop;
    return integration;
  }

  IntegrationResult relax() {
    Relaxation r = relaxation();
    switch (options_.chosen.integrator) {
      case IntegratorKind::lbfgs:
        return relax_lbfgs(r, integration(), lbfgs(), watch("relax"));
      case IntegratorKind::damped: {
        if (moving_.n_vertices() == 0)
          moving_ = build_mesh(work_.vertices.positions.points, *work_.adjacency);
        return relax_damped(r, moving_, integration(), options_.chosen.damped, watch("relax"));
      }
    }
    throw Error("unknown integrator");
  }

  /// Mode `adapt` keeps the field of the input, as a coarser mesh has less detail.
  bool refits() const {
    return options_.chosen.refit == Refit::each && options_.chosen.connectivity != ConnectivityMode::adapt &&
           !free_of_guards_;
  }

  /// Did the relaxation come to rest with hardly a step limited by guards? Then the surface is smooth at the
  /// scale of the mesh, a new field fitted to it is the same surface, and the minimum is the same, unless
  /// target lengths vary.
  bool is_free_of_guards(const IntegrationResult& relaxed) const {
    const double vertex_steps = static_cast<double>(relaxed.evaluations) * work_.adjacency->vertex_count;
    return options_.chosen.integrator == IntegratorKind::lbfgs && !work_.has_varying_lengths() &&
           relaxed.reason == StopReason::stalled &&
           static_cast<double>(relaxed.limited_steps) <= options_.guard_limited * vertex_steps;
  }

  /// Does the next iteration or the angle optimisation continue on the same field, without projection?
  bool goes_on() const {
    return polishes() && (free_of_guards_ || options_.chosen.connectivity == ConnectivityMode::adapt);
  }

  /// Not with rest ratios: larger angles of two triangles make a rhombus of a square.
  bool polishes() const { return options_.chosen.polish_angles && !work_.has_rest_ratios(); }

  void iterate() {
    const Stage stage(work_.stopwatch, "relax");
    if (refits() && outer_ > 1) projection_.refit();
    const double energy = present_energy();
    IntegrationResult relaxed = relax();
    guard_limited_ = relaxed.limited_steps > 0;
    free_of_guards_ = is_free_of_guards(relaxed);
    if (!goes_on() || relaxed.reason == StopReason::interrupted) {
      project_to_input();
      if (projection_.reverted_crossings()) relaxed.energy = present_energy();
    } else {
      work_.resample_lengths();
    }
    record("relax", relaxed, outer_);
    if (result_.iterations.back().max_length_error < options_.chosen.tolerance)
      return stop(StopReason::converged);
    if (relaxed.reason == StopReason::interrupted) return stop(StopReason::interrupted);
    if (relaxed.reason == StopReason::jammed && relaxed.steps == 0) return stop(StopReason::jammed);
    if (free_of_guards_ || energy - relaxed.energy <= options_.outer_drop * energy)
      return stop(StopReason::stalled);
    result_.reason = StopReason::step_limit;
  }

  void raise_angles() {
    const Stage stage(work_.stopwatch, "polish");
    if (refits()) projection_.refit();
    AngleSpringResult raised;
    {
      Relaxation r = relaxation();
      const AngleSpringOptions& options = options_.chosen.connectivity == ConnectivityMode::fixed
                                              ? options_.angle_springs
                                              : options_.flips.angle_springs;
      raised = hooke::raise_angles(r, work_.targets, options, watch("polish"));
    }
    if (raised.interrupted) {
      result_.reason = StopReason::interrupted;
      project_to_input();
    } else {
      search();
    }
    record("polish", {.steps = raised.sweeps, .energy = present_energy()});
  }

  /// Searches on the field fitted last, where vertices can move that the final projection would revert, and
  /// again on the field of the input, as the projection may have changed the worst angles.
  void search() {
    if (work_.refitted()) {
      project_drifted(guards_, *work_.retraction, work_.vertices.positions);
      search_on_current_field();
    }
    project_to_input();
    work_.return_to_input();
    result_.unprojected = projection_.project(search_on_current_field());
    work_.resample_lengths();
  }

  /// Returns the vertices that may have moved.
  std::vector<int> search_on_current_field() {
    return timed(work_.stopwatch, "search", [&] {
      Relaxation r = relaxation();
      return search_angles(r, options_.search).vertices;
    });
  }

  void project_to_input() {
    result_.unprojected = projection_.project();
    work_.resample_lengths();
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
    result_.limited_steps += done.limited_steps;
  }

  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  const RunOptions& options_;
  const Observer& observer_;
  Workspace& work_;
  Guards guards_;
  FinalProjection projection_;
  RemeshResult result_;
  TriMesh moving_;  // with velocities and forces; made by the first damped relaxation
  double seconds_before_ = 0;
  int outer_ = 0;
  bool guard_limited_ = true;  // did guards limit steps of the last relaxation?
  bool free_of_guards_ = false;
  bool done_ = false;
};

/// Fewer iterations, as after a coarser mesh, which leaves the vertices nearly at rest.
RunOptions with_fewer_iterations(RunOptions options) {
  options.max_outer = std::min(options.max_outer, options.adaptation.last_outer);
  int& steps = options.integration.max_steps;
  if (options.chosen.integrator == IntegratorKind::lbfgs)
    steps = std::min(steps, options.adaptation.last_steps.value_or(steps));
  return options;
}

/// One pass of sliver removal after others that have `tested` so many, which it adds to. Returns whether an
/// edge was changed.
bool remove_slivers_once(Workspace& work, const RunOptions& options, const Observer& observer, int& tested,
                         RemeshResult& result) {
  const auto start = std::chrono::steady_clock::now();
  const Observer watch = [&](Progress p) {
    p.stage = "mend";
    if (observer && !observer(p)) result.reason = StopReason::interrupted;
    return result.reason != StopReason::interrupted;
  };
  const SliverChanges changes = timed(work.stopwatch, "mend", [&] {
    return remove_slivers(work, options.chosen.connectivity, {.altitude = options.chosen.altitude},
                          options.slivers, options.limits, tested, watch);
  });
  tested += changes.tested;
  if (changes.count() == 0) return false;
  RunOptions rest = options;
  rest.search.sagitta = max_sagitta_near_slivers;
  const double before = result.iterations.empty() ? 0 : result.iterations.back().seconds;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  result = OuterIterations(work, rest, observer).search_again(std::move(result), before + elapsed.count());
  result.flips.flips += changes.flips;
  result.adaptation.splits += changes.splits;
  result.adaptation.collapses += changes.collapses;
  return true;
}

void remove_slivers_in_passes(Workspace& work, const RunOptions& options, const Observer& observer,
                              RemeshResult& result) {
  bool changed = options.chosen.polish_angles;
  int tested = 0;
  for (int pass = 0; changed && pass < sliver_passes; ++pass)
    changed = result.reason != StopReason::interrupted &&
              remove_slivers_once(work, options, observer, tested, result);
}

/// By the ids of the result, those of the input before anything is changed.
std::vector<Edge> crease_edges_by_id(const Workspace& work) {
  std::vector<Edge> edges = crease_edges(*work.adjacency);
  for (Edge& e : edges)
    for (int& v : e) v = work.order.old_vertex[v];
  return edges;
}

/// What a result says of its vertices and creases, once they are where they stay.
void describe(const Workspace& work, const RunOptions& options, RemeshResult& result) {
  const Guards guards(*work.adjacency, work.targets, options.limits);
  result.vertex_limits = vertex_limits_of_result(work, guards, options.chosen.constraints);
  result.creases = count_creases(*work.adjacency, work.order, result.vertex_limits);
  result.crease_edges = crease_edges_by_id(work);
  result.projection = work.projection_counts();
}

/// Before anything is changed.
void count_input_creases(const Workspace& work, const CreaseOptions& options, RemeshResult& result) {
  result.input_creases = crease_edges_by_id(work);
  if (options.angle >= 180) return;
  for (int e : sharp_edges(*work.start, *work.adjacency, options.angle)) {
    ++result.creases.sharp;
    result.creases.dropped += !work.adjacency->is_crease(e);
  }
}

/// Lets a result tell also what was done for the one that it goes on from.
void add_earlier(const RemeshResult& before, RemeshResult& result) {
  result.input_creases = before.input_creases;
  result.creases.sharp = before.creases.sharp;
  result.creases.dropped = before.creases.dropped;
  result.folded_before = before.folded_before;
  result.limited_steps += before.limited_steps;
  result.unprojected = std::max(result.unprojected, before.unprojected);
  int outer = 0;
  for (const IterationRecord& record : before.iterations) outer = std::max(outer, record.outer);
  for (IterationRecord& record : result.iterations) {
    if (!before.iterations.empty()) record.seconds += before.iterations.back().seconds;
    if (record.outer > 0) record.outer += outer;
  }
  result.iterations.insert(result.iterations.begin(), before.iterations.begin(), before.iterations.end());
  const AdaptResult& a = before.adaptation;
  result.adaptation.levels = a.levels;
  result.adaptation.rounds += a.rounds;
  result.adaptation.count_rounds += a.count_rounds;
  result.adaptation.splits += a.splits;
  result.adaptation.collapses += a.collapses;
  result.adaptation.flips += a.flips;
  const FlipResult& f = before.flips;
  result.flips.flips += f.flips;
  result.flips.flow_rounds += f.flow_rounds;
  result.flips.spring_rounds += f.spring_rounds;
  result.flips.passes += f.passes;
  result.flips.evaluations += f.evaluations;
}

}  // namespace

Run::Run(const TriMesh& mesh, MemoryOrder memory_order, const RunOptions& options, const Observer& observer,
         Stopwatch* stopwatch, const std::vector<PlacedLength>& shorter)
    : options_(std::make_unique<const RunOptions>(options)),
      observer_(observer),
      work_(std::make_unique<Workspace>(mesh, std::move(memory_order), options.chosen.constraints,
                                        options.chosen.filter, options.retraction, stopwatch, shorter)) {
  if ((work_->has_edge_lengths() || work_->has_rest_ratios()) &&
      options.chosen.connectivity != ConnectivityMode::fixed)
    throw Error("target lengths of single edges; expected connectivity fixed, where edges stay");
}

Run::~Run() = default;

RemeshResult Run::remesh(TriMesh& mesh) {
  ++results_;
  RemeshResult input;
  count_input_creases(*work_, options_->chosen.constraints.features, input);
  RemeshResult result = change(mesh);
  result.input_creases = std::move(input.input_creases);
  result.creases.sharp = input.creases.sharp;
  result.creases.dropped = input.creases.dropped;
  return result;
}

Mat3X Run::points(const TriMesh& input) const {
  return work_->points_of_result(vertex_points(input));
}

std::optional<RemeshResult> Run::go_on(TriMesh& mesh, const RemeshResult& before,
                                       const std::vector<int>& placed, const Mat3X& points,
                                       const std::vector<double>& lengths,
                                       const std::vector<PlacedLength>& shorter_places) {
  constexpr double max_share = .5;   // of the vertices; more are better distributed anew
  constexpr double rounding = 1e-9;  // of lengths
  constexpr int rings = 3;           // around shorter lengths, for faces of lengths between
  if (!work_->vertices.constraints.junction.empty() || options_->adaptation.min_length > 0)
    return std::nullopt;
  ++results_;
  const std::vector<double> lengths_before = work_->vertices.vertex_length;
  work_->set_lengths(lengths, shorter_places);
  std::vector<int> shorter;
  for (std::size_t v = 0; v < lengths_before.size(); ++v)
    if (work_->vertices.vertex_length[v] < (1 - rounding) * lengths_before[v])
      shorter.push_back(static_cast<int>(v));
  const std::vector<int> movable = with_rings(*work_->adjacency, shorter, rings);
  share_of_last_ = static_cast<double>(movable.size()) / static_cast<double>(lengths_before.size());
  if (movable.empty() || share_of_last_ > max_share) return std::nullopt;
  std::vector<char> may_move(lengths_before.size(), 0);
  for (int v : movable) may_move[v] = 1;
  work_->place(placed, points);  // last: elsewhere lengths are others, which are not shorter for it
  work_->hold_others(may_move);
  RemeshResult result = change(mesh);
  add_earlier(before, result);
  return result;
}

/// All that changes what is not held.
RemeshResult Run::change(TriMesh& mesh) {
  Workspace& work = *work_;
  const bool goes_on = work.has_held_vertices();
  const EnergyTerms terms{.altitude = options_->chosen.altitude};
  AdaptResult adapted;
  FlipResult flips;
  if (options_->chosen.connectivity == ConnectivityMode::adapt)
    adapted = timed(work.stopwatch, "adapt",
                    [&] { return adapt(work, options_->adaptation, terms, options_->limits, observer_); });
  flips.interrupted = adapted.interrupted;
  if (options_->chosen.connectivity != ConnectivityMode::fixed && !flips.interrupted)
    flips = timed(work.stopwatch, "flip", [&] {
      const FlipOptions then = flips_after(adapted, options_->adaptation, options_->flips);
      return run_flip_mode(work, then, terms, options_->limits, observer_);
    });
  RunOptions then = *options_;
  const bool near_regular = options_->chosen.connectivity == ConnectivityMode::fixed &&
                            !work.has_edge_lengths() && keep_near_regular(work, then.limits);
  const bool is_near_rest = adapted.levels > 0 || goes_on;
  if (is_near_rest && options_->chosen.polish_angles) then = with_fewer_iterations(std::move(then));
  OuterIterations iterations(work, then, observer_);
  RemeshResult result = iterations.run(flips);
  const Mat3X velocities = iterations.velocities();
  result.near_regular = near_regular;
  result.adaptation = adapted;
  switch (options_->chosen.connectivity) {
    case ConnectivityMode::fixed:
      break;
    case ConnectivityMode::flip:
      result.folded_before = flips.folded_before;
      remove_slivers_in_passes(work, *options_, observer_, result);
      measure_travel(work, result.flips);
      break;
    case ConnectivityMode::adapt:
      result.folded_before = adapted.folded_before;
      remove_slivers_in_passes(work, *options_, observer_, result);
      break;
  }
  if (goes_on) {
    work.release();
    result.adaptation.target_faces = target_face_count(work.vertices, work.adjacency->faces);
  }
  describe(work, then, result);
  if (options_->chosen.map) result.map = work.map();
  result.input_points = work.copy_back(mesh);
  result.memory_order = work.memory_order();
  const bool has_velocities = velocities.cols() > 0 && options_->chosen.connectivity !=
                                                           ConnectivityMode::adapt;  // by the same vertices
  set_vertex_vectors(mesh, velocity_property,
                     has_velocities ? result.memory_order.order.scatter(velocities)
                                    : Mat3X(Mat3X::Zero(3, vertex_points(mesh).cols())));
  set_residual_forces(mesh, result.memory_order, options_->chosen.altitude);
  return result;
}

}  // namespace hooke
