#include "hooke/report.h"

#include <sys/resource.h>

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

/// What mode `flip` did: null without it. Travel is in target lengths.
Json flips_json(const RunRecord& run) {
  if (!run.result || run.result->flips.flow.rounds == 0) return nullptr;
  const FlipResult& f = run.result->flips;
  return {{"flips", f.flips},   {"flow_rounds", f.flow.rounds}, {"spring_rounds", f.spring_rounds},
          {"passes", f.passes}, {"max_travel", f.max_travel},   {"rms_travel", f.rms_travel}};
}

}  // namespace

std::string connectivity_sha256(const std::vector<Triangle>& faces) {
  std::string bytes;
  bytes.reserve(12 * faces.size());
  for (const Triangle& t : faces)
    for (int v : t)
      for (int shift = 0; shift < 32; shift += 8)
        bytes.push_back(static_cast<char>(static_cast<std::uint32_t>(v) >> shift & 0xff));
  return sha256(bytes);
}

Json parameters_json(const RemeshOptions& o) {
  Json j;
  j["paper"] = false;
  j["connectivity"] = o.connectivity == ConnectivityMode::fixed ? "fixed" : "flip";
  j["flow_rounds"] = o.connectivity == ConnectivityMode::fixed ? 0 : o.flips.flow.rounds;
  j["integrator"] = o.integrator == IntegratorKind::lbfgs ? "lbfgs" : "damped";
  j["polish"] = o.polish_angles;
  add_filter(j, o.filter);
  j["refit"] = o.refit == Refit::each ? "each" : "once";
  j["altitude"] = o.altitude;
  j["string"] = o.damped.string;
  j["torque"] = o.damped.torque;
  j["friction"] = o.damped.friction;
  j["tolerance"] = o.tolerance;
  j["max_outer"] = o.max_outer;
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
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return {thread_count(), wall_seconds, seconds(usage.ru_utime) + seconds(usage.ru_stime),
          usage.ru_maxrss * 1024LL};
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
  }
  j["features"] = creases_json(run);
  j["flips"] = flips_json(run);
  j["gates"] = Json::array();
  j["warnings"] = Json::array();
  for (const Warning& w : run.warnings) j["warnings"].push_back({{"code", w.code}, {"message", w.message}});
  j["repairs"] = Json::array();
  j["paper"] = paper_columns(run);
  j["resources"] = {{"threads", run.resources.threads},
                    {"wall_s", run.resources.wall_s},
                    {"cpu_s", run.resources.cpu_s},
                    {"peak_rss_bytes", run.resources.peak_rss_bytes}};
  return j;
}

}  // namespace hooke
