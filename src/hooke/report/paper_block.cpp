#include "hooke/report/paper_block.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <numbers>

#include "hooke/mesh/curvature.h"
#include "hooke/report/report.h"
#include "hooke/springs/forces.h"

namespace hooke {

PaperFigures measure_paper_figures(const Mat3X& points, const Adjacency& adjacency,
                                   const UniformVector& edge_targets, bool with_fitted_curvature) {
  const std::vector<double> targets = edge_targets.values();
  PaperFigures figures;
  figures.string_energy = string_energy(points, adjacency, targets);
  figures.altitude_energy = altitude_energy(points, nullptr, adjacency, targets);
  if (with_fitted_curvature) {
    VertexCurvature curvature = fitted_curvature(points, adjacency);
    figures.fitted_mean_curvature = range_of(std::move(curvature.mean));
    figures.fitted_gaussian_curvature = range_of(std::move(curvature.gaussian));
  }
  return figures;
}

namespace {

using Json = nlohmann::ordered_json;

/// What each outer iteration of paper_remesh() did, and its state at the end. Lengths are mean target
/// lengths.
Json evolution_json(const std::vector<TimeStepRecord>& steps) {
  Json outers = Json::array();
  BoundCounts bound;
  for (size_t k = 0; k < steps.size(); ++k) {
    const TimeStepRecord& s = steps[k];
    bound.add(s.bound);
    if (k + 1 < steps.size() && steps[k + 1].outer == s.outer) continue;
    outers.push_back({{"outer", s.outer},
                      {"steps", s.step},
                      {"time", s.time},
                      {"dt", s.step_time},
                      {"string_energy", s.string_energy},
                      {"altitude_energy", s.altitude_energy},
                      {"kinetic_energy", s.kinetic_energy},
                      {"greatest_force", s.max_force},
                      {"greatest_length_error", s.max_length_error},
                      {"bound",
                       {{"angle", bound.angle},
                        {"expansion", bound.expansion},
                        {"displacement", bound.displacement},
                        {"area", bound.area_bound},
                        {"none", bound.none}}}});
    bound = {};
  }
  return outers;
}

Json columns(const Quality& q, const PaperFigures& figures) {
  const auto fitted = [](const std::optional<Range>& range) { return range ? to_json(*range) : Json(); };
  return {{"vertices", q.topology.vertices},
          {"least_angle_rad", q.min_angle.min * std::numbers::pi / 180},
          {"edge_length_sd", q.edge_length.std},
          {"mean_curvature", to_json(q.mean_curvature)},
          {"gaussian_curvature", to_json(q.gaussian_curvature)},
          {"fitted_mean_curvature", fitted(figures.fitted_mean_curvature)},
          {"fitted_gaussian_curvature", fitted(figures.fitted_gaussian_curvature)},
          {"string_energy", figures.string_energy},
          {"altitude_energy", figures.altitude_energy}};
}

}  // namespace

Json paper_block(const RunRecord& run) {
  Json j = {{"before", columns(run.before, run.paper_before)},
            {"after", nullptr},
            {"greatest_displacement", nullptr}};
  if (run.after && run.paper_after) j["after"] = columns(*run.after, *run.paper_after);
  if (run.deviation && run.deviation->displacement)
    j["greatest_displacement"] = run.deviation->displacement->max;
  j["evolution"] = run.result ? evolution_json(run.result->time_steps) : Json::array();
  return j;
}

namespace {

std::string words_of(const FailedTests& bound) {
  std::vector<const char*> words;
  if (bound.angle) words.push_back("angle");
  if (bound.expansion) words.push_back("expansion");
  if (bound.displacement) words.push_back("displacement");
  if (bound.area_bound) words.push_back("area");
  return words.empty() ? "none" : fmt::format("{}", fmt::join(words, "+"));
}

}  // namespace

std::string time_steps_csv(const std::vector<TimeStepRecord>& steps) {
  std::string csv =
      "outer,step,time,dt,bound,string_energy,altitude_energy,kinetic_energy,greatest_force,"
      "greatest_length_error\n";
  for (const TimeStepRecord& s : steps)
    csv += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", s.outer, s.step, s.time, s.step_time,
                       words_of(s.bound), s.string_energy, s.altitude_energy, s.kinetic_energy, s.max_force,
                       s.max_length_error);
  return csv;
}

}  // namespace hooke
