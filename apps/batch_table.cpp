#include "batch_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <string_view>
#include <utility>

#include "exit_codes.h"
#include "hooke/core/error.h"
#include "hooke/core/printable.h"
#include "hooke/io/files.h"
#include "hooke/io/sha256.h"
#include "run_files.h"

namespace hooke::app {

std::string failure_word(int exit_code) {
  switch (exit_code) {
    case usage:
      return "usage";
    case malformed_input:
      return "malformed_input";
    case unacceptable_mesh:
      return "unacceptable_mesh";
    case output_failed:
      return "output_failed";
    case numerical_failure:
      return "numerical_failure";
    case limit_reached:
      return "limit_reached";
    case promise_broken:
      return "promise_broken";
    default:
      return "internal_error";
  }
}

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::array<std::pair<const char*, const char*>, 19> report_columns = {{
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
  for (const auto& [name, place] : report_columns) row[name] = value_at(outcome.report, place);
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

// In words.

namespace {

std::string outcome_word(const Json& row) {
  const int code = row["exit_code"].get<int>();
  return code == done || code == gate_failed ? "done" : row["status"].get<std::string>();
}

}  // namespace

std::string row_in_words(const Json& row) {
  std::string line = fmt::format("{}: {} in {:.2f} s", printable(row["file"].get<std::string>()),
                                 outcome_word(row), row["seconds"].get<double>());
  if (row["exit_code"].get<int>() == gate_failed) line += ", but --require or --compare does not hold";
  const Json &before = row["least_angle_before"], &after = row["least_angle_after"];
  if (before.is_number() && after.is_number())
    line += fmt::format(": least angle {:.3g} -> {:.3g} degrees", before.get<double>(), after.get<double>());
  else if (before.is_number())
    line += fmt::format(": least angle {:.3g} degrees", before.get<double>());
  return line + "\n";
}

std::string batch_in_words(const std::vector<int>& codes, int skipped, double seconds) {
  std::map<int, int> failures;
  for (int code : codes)
    if (code != done) ++failures[code];
  std::vector<std::string> parts;
  int failed = 0;
  for (const auto& [code, count] : failures) {
    parts.push_back(fmt::format("{} with exit code {}", count, code));
    failed += count;
  }
  std::string text =
      fmt::format("{} meshes: {} done", codes.size(), static_cast<int>(codes.size()) - failed - skipped);
  if (skipped > 0) text += fmt::format(", {} skipped", skipped);
  if (failed > 0) text += fmt::format(", {} not done ({})", failed, fmt::join(parts, ", "));
  return text + fmt::format(", in {:.2f} s", seconds);
}

// Records of what is done.

namespace {

fs::path place_of_record(const MeshTask& task) {
  fs::path place = task.output;
  place.replace_filename("." + task.output.filename().string() + ".hooke.json");
  return place;
}

/// Of the content; throws InputError.
std::string hash_of(const fs::path& file) {
  const FileBytes bytes = read_regular_file(file);
  return sha256(bytes.text());
}

/// The same if there is such a file, else null.
Json hash_if_there(const fs::path& file) {
  try {
    return hash_of(file);
  } catch (const Error&) {
    return {};
  }
}

Json hashes_of_outputs(const MeshTask& task) {
  Json hashes = Json::array();
  for (const fs::path& output : task.outputs) hashes.push_back(hash_if_there(output));
  return hashes;
}

/// Of this program, so that another build does not take its results for its own.
const Json& hash_of_program() {
  static const Json hash =
      hash_if_there(fs::exists("/proc/self/exe") ? fs::canonical("/proc/self/exe") : fs::path());
  return hash;
}

}  // namespace

std::string work_hash(const Settings& s, const MeshTask& task) {
  try {
    Json work = {{"version", HOOKE_VERSION},
                 {"program", hash_of_program()},
                 {"input", hash_of(task.input)},
                 {"extension", task.input.extension().string()},
                 {"options", task.method}};
    for (const NamedFile& file : data_files(s)) work["files"].push_back(hash_of(file.path));
    return sha256(work.dump(-1, ' ', false, Json::error_handler_t::replace));
  } catch (const Error&) {
    return "";  // the run itself says what is wrong
  }
}

std::optional<Json> row_if_done(const MeshTask& task, const std::string& hash) {
  std::ifstream file(place_of_record(task));
  const Json record = Json::parse(file, nullptr, false);
  if (hash.empty() || !record.is_object() || record.value("work", Json()) != hash) return {};
  const Json row = record.value("row", Json()), hashes = hashes_of_outputs(task);
  if (!row.is_object() || std::ranges::any_of(hashes, &Json::is_null) ||
      record.value("outputs", Json()) != hashes)
    return {};
  return row;
}

void record_done(const MeshTask& task, const std::string& hash, const Json& row) {
  if (hash.empty()) return;
  Json record = {
      {"schema", "hooke-remesh/done/1"}, {"work", hash}, {"outputs", hashes_of_outputs(task)}, {"row", row}};
  PendingFile(place_of_record(task), record.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n")
      .commit();
}

}  // namespace hooke::app
