#include "hooke/report/report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "hooke/core/parallel.h"
#include "hooke/measure/statistics.h"
#include "hooke/remesh/options.h"
#include "hooke/remesh/paper_mode.h"
#include "hooke/remesh/preserving_remesh.h"
#include "hooke/remesh/run_options.h"
#include "hooke/report/report_keys.h"

namespace hooke {
namespace {

using Json = nlohmann::ordered_json;

Json number(double x) {
  return std::isfinite(x) ? Json(x) : Json(nullptr);
}
Json number(std::optional<double> x) {
  return x ? number(*x) : Json(nullptr);
}

Json vector(const Vec3& v) {
  return {number(v.x()), number(v.y()), number(v.z())};
}

/// {"5": vertices with five edges, ...}
Json valence_counts(const std::vector<int>& counts) {
  Json json = Json::object();
  for (size_t k = 0; k < counts.size(); ++k)
    if (counts[k] > 0) json[std::to_string(k)] = counts[k];
  return json;
}

Json worst_faces(const std::vector<WorstFace>& faces) {
  Json json = Json::array();
  for (const WorstFace& w : faces)
    json.push_back({{"face", w.face},
                    {"min_angle", number(w.min_angle)},
                    {"vertices", w.vertices},
                    {"centre", vector(w.centre)},
                    {"bound", number(w.bound.degrees)},
                    {"bound_vertices", w.bound.vertices},
                    {"reasons", w.reasons}});
  return json;
}

Json distance(const MaxRms& d, double diagonal) {
  return {{"max", number(d.max)},
          {"rms", number(d.rms)},
          {"max_over_diagonal", number(d.max / diagonal)},
          {"rms_over_diagonal", number(d.rms / diagonal)}};
}

Json max_rms(const std::optional<MaxRms>& x) {
  if (!x) return nullptr;
  return {{"max", number(x->max)}, {"rms", number(x->rms)}};
}

}  // namespace

Json to_json(const Range& r) {
  return {{"min", number(r.min)}, {"mean", number(r.mean)}, {"max", number(r.max)}};
}

Json to_json(const Statistics& s) {
  Json json = {{"min", number(s.min)},       {"p01", number(s.p01)},   {"p05", number(s.p05)},
               {"median", number(s.median)}, {"mean", number(s.mean)}, {"p95", number(s.p95)},
               {"max", number(s.max)},       {"std", number(s.std)},   {"histogram", nullptr},
               {"non_finite", s.non_finite}};
  if (s.count > 0) json["histogram"] = {{"edges", s.histogram.edges}, {"counts", s.histogram.counts}};
  return json;
}

Json to_json(const Quality& q) {
  Json json;
  json["min_angle"] = to_json(q.min_angle);
  json["max_angle"] = to_json(q.max_angle);
  json["shape"] = to_json(q.shape);
  json["radius_ratio"] = to_json(q.radius_ratio);
  json["aspect_ratio"] = to_json(q.aspect_ratio);
  json["edge_ratio"] = to_json(q.edge_ratio);
  json["edge_length"] = to_json(q.edge_length);
  json["length_error"] = to_json(q.length_error);
  json["faces_below_20"] = q.faces_below_20;
  json["faces_below_30"] = q.faces_below_30;
  json["folded_edges"] = q.folded_edges;
  json["self_intersections"] = q.self_intersections ? Json(*q.self_intersections) : Json(nullptr);
  json["degenerate_faces"] = q.degenerate_faces;
  json["valence"] = {{"interior", valence_counts(q.valence.interior)},
                     {"boundary", valence_counts(q.valence.boundary)}};
  json["mean_curvature"] = to_json(q.mean_curvature);
  json["gaussian_curvature"] = to_json(q.gaussian_curvature);
  json["polygon_angles"] = nullptr;
  if (const auto& angles = q.polygon_angles)
    json["polygon_angles"] = {{"min", number(angles->min)},
                              {"max", number(angles->max)},
                              {"rms_deviation", number(angles->rms_deviation)}};
  json["worst_faces"] = worst_faces(q.worst_faces);
  return json;
}

Json to_json(const Deviation& d) {
  Json json;
  json["displacement"] = max_rms(d.displacement);
  json["distance_to_input"] = distance(d.to_reference, d.diagonal);
  json["distance_from_input"] = distance(d.from_reference, d.diagonal);
  json["normal_deviation"] = max_rms(d.normal_deviation);
  json["area_change"] = number(d.area_change);
  json["volume_change"] = number(d.volume_change);
  json["flipped_faces"] = d.flipped_faces.size();
  json["overhangs"] = d.overhangs;
  json["boundary_distance"] = {{"to_input", number(d.boundary_to_reference)},
                               {"from_input", number(d.boundary_from_reference)}};
  return json;
}

Json to_json(const Topology& t, const Extent& e) {
  Json json;
  json["vertices"] = t.vertices;
  json["faces"] = t.faces;
  json["edges"] = t.edges;
  json["components"] = t.components;
  json["boundary_loops"] = t.boundary_loops;
  json["euler"] = t.euler;
  json["isolated_vertices"] = t.isolated_vertices;
  json["junction_edges"] = t.junction_edges;
  json["bbox"] = {{"min", vector(e.lower)}, {"max", vector(e.upper)}};
  json["bbox_diagonal"] = number(e.diagonal);
  json["area"] = number(e.area);
  json["volume"] = number(e.volume);
  return json;
}

namespace {

Json file_json(const FileRecord& file, const Quality& quality) {
  Json j = {{"path", file.path}, {"sha256", file.sha256}, {"format", file.format}};
  j.update(to_json(quality.topology, quality.extent));
  j["connectivity_sha256"] = file.connectivity_sha256;
  return j;
}

Json iteration_json(const IterationRecord& r) {
  return {{"stage", r.stage},
          {"outer", r.outer > 0 ? Json(r.outer) : Json()},
          {"steps", r.steps},
          {"evaluations", r.evaluations},
          {"energy", r.energy},
          {"max_length_error", r.max_length_error},
          {"rms_length_error", r.rms_length_error},
          {"min_angle", r.min_angle},
          {"field_evaluations", r.field_evaluations},
          {"t_s", r.seconds}};
}

Json projection_json(const ProjectionCounts& counts) {
  const auto status = [&](ProjectionStatus s) { return counts.by_status[static_cast<size_t>(s)]; };
  return {{"calls", counts.calls},
          {"field_evaluations", counts.evaluations},
          {"no_cover", status(ProjectionStatus::no_cover)},
          {"flat_gradient", status(ProjectionStatus::flat_gradient)},
          {"too_far", status(ProjectionStatus::too_far)},
          {"step_limit", status(ProjectionStatus::step_limit)}};
}

Json geometry_json(const RunRecord& run) {
  Json j = to_json(*run.deviation);
  j["folded_faces"] = run.deviation->opposing_faces;
  return j;
}

/// What the result keeps of the input; null if that was not measured.
Json promises_json(const RunRecord& run) {
  if (!run.result || !run.result->measures) return nullptr;
  const Preservation& p = run.result->measures->preservation;
  const char* const rescues[] = {"none", "tips", "junctions", "closest", "put_back", "kept_faces"};
  return {{"kept", p.holds()},
          {"flipped_faces", p.flipped_faces},
          {"new_folds", p.new_folds},
          {"new_self_intersections", p.new_crossings},
          {"new_degenerate_faces", p.new_degenerate_faces},
          {"topology_kept", p.topology_kept},
          {"creases_kept", p.creases_kept},
          {"crease_loss", number(p.crease_loss)},
          {"far_vertices", p.far_vertices.size()},
          {"lost_vertices", p.lost_vertices.size()},
          {"distance_over_limit", number(p.excess)},
          {"place", vector(p.place)},
          {"rescue", rescues[static_cast<int>(run.result->rescue)]},
          {"rescued_parts", run.result->rescued_shells},
          {"shortened_vertices", run.result->shortened},
          {"lengths_of_input", run.result->has_lengths_of_input}};
}

/// Null if no creases were found.
Json creases_json(const RunRecord& run) {
  if (!run.result || run.result->creases.edges == 0) return nullptr;
  const CreaseCounts& c = run.result->creases;
  return {{"chains", c.curves},
          {"crease_edges", c.edges},
          {"seam_edges", run.seam_edges},
          {"sharp_edges", c.sharp},
          {"sharp_edges_dropped", c.dropped},
          {"corners", c.corners},
          {"curve_vertices", c.curve_vertices},
          {"charts", c.charts}};
}

/// Counts of mode `flip`, which also runs after the adaptation in mode `adapt`; null in mode `fixed`. Travel
/// is in target lengths, null in mode `adapt`.
Json flips_json(const RunRecord& run) {
  if (!run.result || run.connectivity == ConnectivityMode::fixed) return nullptr;
  const FlipResult& f = run.result->flips;
  Json j = {{"flips", f.flips},   {"flow_rounds", f.flow_rounds}, {"spring_rounds", f.spring_rounds},
            {"passes", f.passes}, {"max_travel", f.max_travel},   {"rms_travel", f.rms_travel}};
  if (run.result->adaptation.rounds > 0) j["max_travel"] = j["rms_travel"] = nullptr;
  return j;
}

/// Counts of mode `adapt`, null in the other modes.
Json adaptation_json(const RunRecord& run) {
  if (!run.result || run.result->adaptation.rounds == 0) return nullptr;
  const AdaptResult& a = run.result->adaptation;
  return {{"coarse_levels", a.levels},      {"rounds", a.rounds},
          {"count_rounds", a.count_rounds}, {"splits", a.splits},
          {"collapses", a.collapses},       {"flips", a.flips},
          {"wanted_faces", a.target_faces}};
}

/// The parameters, and null for those that have no part in the run.
Json parameters_json(const RunRecord& run) {
  Json j = run.parameters;
  const TargetRecord& t = run.target;
  j.update({{"L", t.mean}, {"L_min", t.min}, {"L_max", t.max}, {"L_natural", t.natural}});
  for (const std::string& name : parameter_names()) j.emplace(name, nullptr);
  return j;
}

Json comparison_json(const RunRecord& run) {
  if (!run.comparison) return nullptr;
  const Comparison& c = *run.comparison;
  Json worse = Json::array();
  for (const Worsening& w : c.worse) worse.push_back({{"key", w.key}, {"base", w.base}, {"value", w.value}});
  return {{"base", c.base},
          {"rtol", c.rtol},
          {"compared", c.compared},
          {"worse", worse},
          {"not_comparable", c.not_comparable}};
}

Json stages_json(const std::vector<StageTime>& stages) {
  Json j = Json::object();
  for (const StageTime& s : stages)
    j[s.name] = {
        {"calls", s.calls}, {"wall_s", s.wall_s}, {"cpu_s", s.cpu_s}, {"peak_rss_bytes", s.peak_rss_bytes}};
  return j;
}

}  // namespace

Resources resources_used(double wall_seconds) {
  const ProcessUse use = process_use();
  return {thread_count(), wall_seconds, use.cpu_s, use.peak_rss_bytes};
}

std::string status_of(StopReason reason) {
  switch (reason) {
    case StopReason::converged:
      return "converged";
    case StopReason::stalled:
      return "stalled";
    case StopReason::jammed:
      return "jammed";
    case StopReason::step_limit:
      return "iteration_limit";
    case StopReason::interrupted:
      return "interrupted";
  }
  return "";
}

Json report_json(const RunRecord& run) {
  Json j;
  j["schema"] = "hooke-remesh/report/1";
  j["tool"] = {{"name", "hooke-remesh"}, {"version", run.tool_version}};
  j["status"] = run.status;
  j["input"] = file_json(run.input, run.before);
  j["output"] = run.output ? file_json(*run.output, *run.after) : Json();
  if (run.output) j["output"]["preserved"] = run.output->preserved;
  j["parameters"] = parameters_json(run);
  j["promises"] = promises_json(run);
  j["before"] = to_json(run.before);
  j["after"] = run.after ? to_json(*run.after) : Json();
  j["geometry"] = run.deviation ? geometry_json(run) : Json();
  j["iterations"] = Json::array();
  j["projection"] = j["held_back"] = j["near_regular"] = j["steps_smoothed"] = nullptr;
  if (run.result) {
    for (const IterationRecord& r : run.result->iterations) j["iterations"].push_back(iteration_json(r));
    j["projection"] = projection_json(run.result->projection);
    j["projection"]["not_landed"] = run.result->unprojected;
    j["held_back"] = run.result->limited_steps;
    j["near_regular"] = run.result->near_regular;
    j["steps_smoothed"] = run.result->steps == MaskSteps::smoothed;
  }
  j["features"] = creases_json(run);
  j["flips"] = flips_json(run);
  j["adaptation"] = adaptation_json(run);
  j["gates"] = Json::array();
  for (const GateOutcome& g : run.gates)
    j["gates"].push_back({{"condition", g.condition}, {"value", number(g.value)}, {"passed", g.passed}});
  j["comparison"] = comparison_json(run);
  j["warnings"] = Json::array();
  for (const Warning& w : run.warnings) j["warnings"].push_back({{"code", w.code}, {"message", w.message}});
  j["repairs"] = Json::array();
  for (const Notes* notes : {&run.notes, &run.repairs})
    for (const Note& n : *notes)
      j["repairs"].push_back({{"code", n.code}, {"count", n.count}, {"message", n.message}});
  j["paper"] = paper_block(run);
  j["resources"] = {{"threads", run.resources.threads},
                    {"wall_s", run.resources.wall_s},
                    {"cpu_s", run.resources.cpu_s},
                    {"peak_rss_bytes", run.resources.peak_rss_bytes},
                    {"stages", stages_json(run.stages)}};
  return j;
}

std::string report_text(const RunRecord& run) {
  constexpr int indent = 2;
  return report_json(run).dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

namespace {

const char* name_of(FilterKind kind) {
  switch (kind) {
    case FilterKind::local:
      return "local";
    case FilterKind::global:
      return "global";
    case FilterKind::closest:
      return "closest";
    case FilterKind::none:
      return "none";
  }
  return "";
}

const char* name_of(BoundaryRule rule) {
  switch (rule) {
    case BoundaryRule::slide:
      return "slide";
    case BoundaryRule::fixed:
      return "fixed";
    case BoundaryRule::free:
      return "free";
  }
  return "";
}

const char* name_of(ConnectivityMode mode) {
  switch (mode) {
    case ConnectivityMode::fixed:
      return "fixed";
    case ConnectivityMode::flip:
      return "flip";
    case ConnectivityMode::adapt:
      return "adapt";
  }
  return "";
}

const char* name_of(Effort effort) {
  switch (effort) {
    case Effort::fast:
      return "fast";
    case Effort::standard:
      return "default";
    case Effort::thorough:
      return "thorough";
  }
  return "";
}

/// The value if it has an effect, else null.
template <typename Value>
Json where(bool effective, const Value& value) {
  return effective ? Json(value) : Json();
}

bool has_splines(FilterKind kind) {
  return kind == FilterKind::local || kind == FilterKind::global;
}

void add_filter(Json& j, const FilterOptions& filter) {
  const bool splines = has_splines(filter.kind);
  j["filter"] = name_of(filter.kind);
  j["kernel"] = where(splines, filter.kernel == Kernel::r3 ? "r3" : "r2logr");
  j["rho"] = where(splines, filter.offset);
  j["rho_unit"] = where(splines, filter.offset_unit == OffsetUnit::edge ? "edge" : "file");
  j["reach"] = where(splines && std::isfinite(filter.max_deviation), filter.max_deviation);
}

void add_angle_springs(Json& j, const RunOptions& o) {
  const AngleSpringOptions& springs =
      o.chosen.connectivity == ConnectivityMode::fixed ? o.angle_springs : o.flips.angle_springs;
  const bool on = o.chosen.polish_angles;
  j["polish"] = on;
  j["polish_from"] = where(on, springs.first_threshold);
  j["polish_margin"] = where(on, springs.margin);
  j["polish_step"] = where(on, springs.threshold_step);
  j["polish_up_to"] = where(on, springs.last_threshold);
  j["polish_sweeps"] = where(on, springs.sweeps);
  j["polish_edge_limit"] = where(on, springs.edge_error_limit);
}

/// Parameters that preserve near-regular meshes, null unless in mode `fixed`.
void add_near_regular(Json& j, const RunOptions& o) {
  const bool fixed = o.chosen.connectivity == ConnectivityMode::fixed;
  j["near_regular_angle"] = where(fixed, NearRegular::angle);
  j["near_regular_deviation"] = where(fixed, NearRegular::deviation);
  j["near_regular_reach"] = where(fixed, NearRegular::max_travel);
}

}  // namespace

Json parameters_json(const RemeshOptions& options) {
  const RunOptions o(options);
  const bool adapts = o.chosen.connectivity == ConnectivityMode::adapt;
  const bool damped = o.chosen.integrator == IntegratorKind::damped;
  const bool fixed = o.chosen.connectivity == ConnectivityMode::fixed;
  Json j;
  j["paper"] = false;
  j["connectivity"] = name_of(o.chosen.connectivity);
  j["effort"] = name_of(options.effort);
  j["flow_rounds"] = fixed ? 0 : o.flips.flow_rounds;
  j["adapt_rounds"] = adapts ? o.adaptation.rounds : 0;
  j["coarse_levels"] = adapts ? o.adaptation.coarse.levels : 0;
  j["last_outer"] = where(adapts && o.chosen.polish_angles, o.adaptation.last_outer);
  j["last_steps"] = where(adapts && o.chosen.polish_angles && !damped && o.adaptation.last_steps,
                          o.adaptation.last_steps.value_or(0));
  j["coarse_flow_rounds"] = adapts ? o.adaptation.coarse_flow : 0;  // if there are coarse levels
  j["last_flow_rounds"] = adapts ? o.adaptation.last_flow : 0;
  j["integrator"] = damped ? "damped" : "lbfgs";
  add_angle_springs(j, o);
  add_near_regular(j, o);
  add_filter(j, o.chosen.filter);
  j["refit"] =
      where(has_splines(o.chosen.filter.kind), o.chosen.refit == Refit::each && !adapts ? "each" : "once");
  j["altitude"] = o.chosen.altitude;
  j["string"] = where(damped, o.chosen.damped.string);
  j["torque"] = where(damped, o.chosen.damped.torque);
  j["friction"] = where(damped, o.chosen.damped.friction);
  j["tolerance"] = o.chosen.tolerance;
  j["max_outer"] = o.max_outer;
  j["outer_drop"] = o.outer_drop;
  j["energy_drop"] = fixed ? o.integration.energy_drop : o.flips.energy_drop;
  j["hindered"] = where(!damped, o.guard_limited);
  j["max_steps"] = o.integration.max_steps;
  j["boundary"] = name_of(o.chosen.constraints.boundary);
  j["corner_angle"] = o.chosen.constraints.corner_angle;
  j["feature_angle"] = where(o.chosen.constraints.features.angle < 180, o.chosen.constraints.features.angle);
  j["feature_noise"] = where(o.chosen.constraints.features.angle < 180,
                             o.chosen.constraints.features.drops_noise ? "auto" : "off");
  j["fixed_vertices"] = o.chosen.constraints.fixed_vertices.size();
  j["guard_area_ratio"] = o.limits.area;
  j["guard_alignment"] = o.limits.alignment;
  j["guard_fold"] = o.limits.fold;
  j["guard_sagitta"] = o.limits.sagitta;
  j["search_sagitta"] = where(o.chosen.polish_angles, o.search.sagitta);
  const bool removes_slivers = o.chosen.polish_angles && !fixed;
  j["sliver_angles"] = where(removes_slivers, o.slivers.sliver_angles);
  j["sliver_passes"] = where(removes_slivers, sliver_passes);
  j["sliver_sagitta"] = where(removes_slivers, max_sagitta_near_slivers);
  return j;
}

Json parameters_json(const PaperOptions& o) {
  Json j;
  j["paper"] = true;
  add_filter(j, o.filter);
  j["filter_every"] = o.filter_every == FilterEvery::step ? "step" : "outer";
  j["refit"] = o.refit == Refit::each ? "each" : "once";
  j["altitude"] = o.evolution.altitude;
  j["string"] = o.evolution.damped.string;
  j["torque"] = o.evolution.damped.torque;
  j["friction"] = o.evolution.damped.friction;
  j["step_angle"] = o.evolution.time_step.angle;
  j["step_expansion"] = o.evolution.time_step.expansion;
  j["step_displacement"] = o.evolution.time_step.displacement;
  j["step_area"] = o.evolution.time_step.area_bound;
  j["tolerance"] = o.evolution.tolerance;
  j["max_outer"] = o.max_outer;
  j["max_steps"] = o.evolution.max_steps;
  j["boundary"] = name_of(o.constraints.boundary);
  j["fixed_vertices"] = o.constraints.fixed_vertices.size();
  return j;
}

}  // namespace hooke
