#include "hooke/report/report.h"

#include <algorithm>
#include <iterator>
#include <numbers>

#include "hooke/core/parallel.h"
#include "hooke/report/quality_json.h"

namespace hooke {

using Json = nlohmann::ordered_json;

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
  if (!run.result || run.parameters.value("connectivity", "fixed") == "fixed") return nullptr;
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
  return {{"coarse_levels", a.levels},      {"rounds", a.rounds},
          {"count_rounds", a.count_rounds}, {"splits", a.splits},
          {"collapses", a.collapses},       {"flips", a.flips},
          {"wanted_faces", a.wanted_faces}};
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
    j["attempts"] = {{"made", run.result->attempts}, {"kept", run.result->kept_attempt}};
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

std::string report_text(const RunRecord& run) {
  constexpr int indent = 2;
  return report_json(run).dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace hooke
