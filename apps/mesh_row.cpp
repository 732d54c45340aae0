#include "mesh_row.h"

#include <array>
#include <utility>

namespace hooke::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::pair<const char*, const char*>, 19> columns = {{
    {"vertices_before", "/input/vertices"},
    {"vertices_after", "/output/vertices"},
    {"faces_before", "/input/faces"},
    {"faces_after", "/output/faces"},
    {"target_length", "/parameters/L"},
    {"least_angle_before", "/before/min_angle/min"},
    {"least_angle_after", "/after/min_angle/min"},
    {"median_angle_before", "/before/min_angle/median"},
    {"median_angle_after", "/after/min_angle/median"},
    {"edge_mean_before", "/before/edge_length/mean"},
    {"edge_mean_after", "/after/edge_length/mean"},
    {"flipped_faces", "/geometry/flipped_faces"},
    {"folded_edges_before", "/before/folded_edges"},
    {"folded_edges_after", "/after/folded_edges"},
    {"self_intersections_before", "/before/self_intersections"},
    {"self_intersections_after", "/after/self_intersections"},
    {"distance_to_input", "/geometry/distance_to_input/max"},
    {"distance_from_input", "/geometry/distance_from_input/max"},
    {"displacement", "/geometry/displacement/max"},
}};

Json value_at(const Json& report, const std::string& place) {
  const Json::json_pointer pointer(place);
  return report.is_object() && report.contains(pointer) ? report.at(pointer) : Json();
}

/// The coefficient of variation of the edge lengths: their standard deviation over their mean.
Json edge_variation(const Json& report, const std::string& state) {
  const Json mean = value_at(report, "/" + state + "/edge_length/mean"),
             deviation = value_at(report, "/" + state + "/edge_length/std");
  if (!mean.is_number() || !deviation.is_number() || mean.get<double>() == 0) return {};
  return deviation.get<double>() / mean.get<double>();
}

std::string csv_cell(const Json& value) {
  if (value.is_null()) return "";
  if (!value.is_string()) return value.dump();
  std::string text = value.get<std::string>();
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

Json mesh_row(const MeshTask& task, const MeshOutcome& outcome) {
  Json row = {{"file", task.input.string()},
              {"output", task.output.empty() ? Json() : Json(task.output.string())},
              {"status", outcome.status},
              {"exit_code", outcome.exit_code},
              {"seconds", outcome.seconds}};
  for (const auto& [name, place] : columns) row[name] = value_at(outcome.report, place);
  for (const char* state : {"before", "after"})
    row[std::string("edge_cv_") + state] = edge_variation(outcome.report, state);
  const Json warnings = value_at(outcome.report, "/warnings");
  row["warnings"] = warnings.is_array() ? Json(warnings.size()) : Json();
  row["message"] = outcome.message.empty() ? Json() : Json(outcome.message);
  return row;
}

std::string table_text(const std::vector<Json>& rows, const std::filesystem::path& file) {
  constexpr auto replace = Json::error_handler_t::replace;
  std::string text;
  if (file.extension() == ".jsonl") {
    for (const Json& row : rows) text += row.dump(-1, ' ', false, replace) + "\n";
    return text;
  }
  for (const auto& [name, value] : rows.at(0).items()) text += (text.empty() ? "" : ",") + name;
  text += "\n";
  for (const Json& row : rows) {
    std::string line;
    for (const auto& [name, value] : row.items()) {
      if (name != "file") line += ',';
      line += csv_cell(value);
    }
    text += line + "\n";
  }
  return text;
}

}  // namespace hooke::app
