#include "hooke/report.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <numbers>

#include "hooke/io/sha256.h"
#include "hooke/parallel.h"
#include "hooke/quality_json.h"

namespace hooke {

using Json = nlohmann::ordered_json;

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

void add_filter(Json& j, const FilterOptions& filter) {
  j["filter"] = name_of(filter.kind);
  j["kernel"] = filter.kernel == Kernel::r3 ? "r3" : "r2logr";
  j["rho"] = filter.offset;
}

Json file_json(const FileRecord& file, const Quality& quality) {
  Json j = {{"path", file.path}, {"sha256", file.sha256}, {"format", file.format}};
  j.update(to_json(quality.topology, quality.extent));
  j["connectivity_sha256"] = file.connectivity_sha256;
  return j;
}

Json iteration_json(const IterationRecord& r) {
  return {{"stage", r.stage},
          {"steps", r.steps},
          {"evaluations", r.evaluations},
          {"energy", r.energy},
          {"max_length_error", r.max_length_error},
          {"rms_length_error", r.rms_length_error},
          {"min_angle", r.least_angle},
          {"field_evaluations", r.field_evaluations},
          {"t_s", r.seconds}};
}

Json projection_json(const ProjectionCounts& counts) {
  const auto status = [&](FootStatus s) { return counts.by_status[static_cast<size_t>(s)]; };
  return {{"calls", counts.calls},
          {"field_evaluations", counts.evaluations},
          {"no_cover", status(FootStatus::no_cover)},
          {"flat_gradient", status(FootStatus::flat_gradient)},
          {"too_far", status(FootStatus::too_far)},
          {"step_limit", status(FootStatus::step_limit)}};
}

/// The columns of the paper's tables 1 to 3.
Json paper_columns(const RunRecord& run) {
  const auto columns = [](const Quality& q) {
    return Json{{"least_angle_rad", q.min_angle.min * std::numbers::pi / 180},
                {"edge_length_sd", q.edge_length.std}};
  };
  Json j = {{"before", columns(run.before)}, {"after", nullptr}, {"greatest_displacement", nullptr}};
  if (run.after) j["after"] = columns(*run.after);
  if (run.deviation && run.deviation->displacement)
    j["greatest_displacement"] = run.deviation->displacement->max;
  return j;
}

Json geometry_json(const RunRecord& run) {
  Json j = to_json(*run.deviation);
  j["folded_faces"] = folded_faces(run);
  return j;
}

/// Null where none were found.
Json creases_json(const RunRecord& run) {
  if (!run.result || run.result->creases.edges == 0) return nullptr;
  const CreaseCounts& c = run.result->creases;
  return {{"chains", c.curves},
          {"crease_edges", c.edges},
          {"crease_edges_kept", c.kept},
          {"corners", c.corners},
          {"curve_vertices", c.curve_vertices},
          {"charts", c.charts}};
}

/// What mode `flip` did, and mode `adapt` after it had adapted: null without. Travel is in target lengths,
/// null where vertices came and went.
Json flips_json(const RunRecord& run) {
  if (!run.result || run.result->flips.flow.rounds == 0) return nullptr;
  const FlipResult& f = run.result->flips;
  Json j = {{"flips", f.flips},   {"flow_rounds", f.flow.rounds}, {"spring_rounds", f.spring_rounds},
            {"passes", f.passes}, {"max_travel", f.max_travel},   {"rms_travel", f.rms_travel}};
  if (run.result->adaptation.rounds > 0) j["max_travel"] = j["rms_travel"] = nullptr;
  return j;
}

/// What mode `adapt` did: null without it.
Json adaptation_json(const RunRecord& run) {
  if (!run.result || run.result->adaptation.rounds == 0) return nullptr;
  const AdaptResult& a = run.result->adaptation;
  return {{"rounds", a.rounds}, {"count_rounds", a.count_rounds},
          {"splits", a.splits}, {"collapses", a.collapses},
          {"flips", a.flips},   {"wanted_faces", a.wanted_faces}};
}

Json stages_json(const std::vector<StageTime>& stages) {
  Json j = Json::object();
  for (const StageTime& s : stages)
    j[s.name] = {
        {"calls", s.calls}, {"wall_s", s.wall_s}, {"cpu_s", s.cpu_s}, {"peak_rss_bytes", s.peak_rss_bytes}};
  return j;
}

}  // namespace

std::string connectivity_sha256(const std::vector<Triangle>& faces) {
  std::string bytes(12 * faces.size(), 0);
  char* at = bytes.data();
  for (const Triangle& t : faces)
    for (int v : t)
      for (int shift = 0; shift < 32; shift += 8)
        *at++ = static_cast<char>(static_cast<std::uint32_t>(v) >> shift & 0xff);
  return sha256(bytes);
}

Json parameters_json(const RemeshOptions& o) {
  Json j;
  j["paper"] = false;
  j["connectivity"] = name_of(o.connectivity);
  j["flow_rounds"] = o.connectivity == ConnectivityMode::fixed ? 0 : o.flips.flow.rounds;
  j["integrator"] = o.integrator == IntegratorKind::lbfgs ? "lbfgs" : "damped";
  j["polish"] = o.polish_angles;
  const PolishOptions& polish = o.connectivity == ConnectivityMode::flip ? o.flips.polish : o.polish;
  j["polish_sweeps"] = polish.sweeps;
  j["polish_step"] = polish.threshold_step;
  j["polish_up_to"] = polish.last_threshold;
  j["polish_edge_limit"] = polish.edge_error_limit;
  add_filter(j, o.filter);
  const bool adapts = o.connectivity == ConnectivityMode::adapt;
  j["adapt_rounds"] = adapts ? o.adaptation.rounds : 0;
  j["refit"] = o.refit == Refit::each && !adapts ? "each" : "once";
  j["altitude"] = o.altitude;
  j["string"] = o.damped.string;
  j["torque"] = o.damped.torque;
  j["friction"] = o.damped.friction;
  j["tolerance"] = o.tolerance;
  j["max_outer"] = o.max_outer;
  j["outer_drop"] = o.outer_drop;
  j["max_steps"] = o.integration.max_steps;
  j["boundary"] = name_of(o.constraints.boundary);
  j["corner_angle"] = o.constraints.corner_angle;
  j["feature_angle"] = o.constraints.features.angle < 180 ? Json(o.constraints.features.angle) : Json();
  j["fixed_vertices"] = o.constraints.fixed_vertices.size();
  j["guard_area_ratio"] = o.guards.area_ratio;
  j["guard_alignment"] = o.guards.alignment;
  j["guard_fold"] = o.guards.fold;
  j["guard_sagitta"] = o.guards.sagitta;
  return j;
}

Json parameters_json(const PaperOptions& o) {
  Json j;
  j["paper"] = true;
  add_filter(j, o.filter);
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

Resources resources_used(double wall_seconds) {
  const ProcessUse use = process_use();
  return {thread_count(), wall_seconds, use.cpu_s, use.peak_rss_bytes};
}

std::string status_of(StopReason reason) {
  switch (reason) {
    case StopReason::converged:
      return "converged";
    case StopReason::stalled:
    case StopReason::jammed:
      return "stalled";
    case StopReason::step_limit:
      return "iteration_limit";
    case StopReason::interrupted:
      return "interrupted";
  }
  return "";
}

std::vector<int> folded_faces(const RunRecord& run) {
  std::vector<int> ids;
  std::ranges::set_union(run.result->folded_faces, run.deviation->opposing_faces, std::back_inserter(ids));
  return ids;
}

Json report_json(const RunRecord& run) {
  Json j;
  j["schema"] = "hooke-remesh/report/1";
  j["tool"] = {{"name", "hooke-remesh"}, {"version", run.tool_version}};
  j["status"] = run.status;
  j["input"] = file_json(run.input, run.before);
  j["output"] = run.output ? file_json(*run.output, *run.after) : Json();
  j["parameters"] = run.parameters;
  j["before"] = to_json(run.before);
  j["after"] = run.after ? to_json(*run.after) : Json();
  j["geometry"] = run.deviation ? geometry_json(run) : Json();
  j["iterations"] = Json::array();
  j["projection"] = nullptr;
  if (run.result) {
    for (const IterationRecord& r : run.result->iterations) j["iterations"].push_back(iteration_json(r));
    j["projection"] = projection_json(run.result->projection);
    j["projection"]["not_landed"] = run.result->not_landed;
    j["held_back"] = run.result->held_back;
    j["near_regular"] = run.result->near_regular;
  }
  j["features"] = creases_json(run);
  j["flips"] = flips_json(run);
  j["adaptation"] = adaptation_json(run);
  j["gates"] = Json::array();
  j["warnings"] = Json::array();
  for (const Warning& w : run.warnings) j["warnings"].push_back({{"code", w.code}, {"message", w.message}});
  j["repairs"] = Json::array();
  j["paper"] = paper_columns(run);
  j["resources"] = {{"threads", run.resources.threads},
                    {"wall_s", run.resources.wall_s},
                    {"cpu_s", run.resources.cpu_s},
                    {"peak_rss_bytes", run.resources.peak_rss_bytes},
                    {"stages", stages_json(run.stages)}};
  return j;
}

}  // namespace hooke
