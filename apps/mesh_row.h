// A row of the table of a batch: what became of a mesh.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

#include "batch_plan.h"

namespace hooke::app {

/// What a mesh of a batch came to.
struct MeshOutcome {
  int exit_code = 0;
  std::string status;   // that of the report, or what went wrong in a word
  std::string message;  // of the error; empty if there was none
  double seconds = 0;
  nlohmann::ordered_json report;  // null without one
};

/// The row: file, output, status, exit_code, seconds, numbers of the report before and after, message; null
/// for what there is not. Lengths in file units, angles in degrees.
nlohmann::ordered_json mesh_row(const MeshTask& task, const MeshOutcome& outcome);

/// The rows as text: CSV with a line of names, or for the extension .jsonl an object a line.
std::string table_text(const std::vector<nlohmann::ordered_json>& rows, const std::filesystem::path& file);

}  // namespace hooke::app
