// The table of a batch: a row for each mesh, what became of it; the rows in words; and the records beside
// outputs from which a later run takes rows of what is done (--skip-existing).
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
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

/// The status of a mesh whose run left no report.
std::string failure_word(int exit_code);

/// The row: file, output, status, exit_code, seconds, numbers of the report before and after, message; null
/// for what there is not. Lengths in file units, angles in degrees.
nlohmann::ordered_json mesh_row(const MeshTask& task, const MeshOutcome& outcome);

/// The rows as text: CSV with a line of names, or for the extension .jsonl an object a line.
std::string table_text(const std::vector<nlohmann::ordered_json>& rows, const std::filesystem::path& file);

/// A line about a mesh, from its row of the table.
std::string row_in_words(const nlohmann::ordered_json& row);

/// How many meshes were done, skipped and not done, from the exit codes of all; without line break.
std::string batch_in_words(const std::vector<int>& codes, int skipped, double seconds);

// What made an output, in a hidden file beside it.

/// SHA-256 of all that decides on the result of the task: the content of the input and of files that options
/// name, the options, and this program. Empty if a file cannot be read.
std::string work_hash(const Settings& settings, const MeshTask& task);

/// The row of the table that a run of this hash has left, if all its outputs are there and as it wrote them.
std::optional<nlohmann::ordered_json> row_if_done(const MeshTask& task, const std::string& hash);

/// Writes down that the task is done. Throws OutputError.
void record_done(const MeshTask& task, const std::string& hash, const nlohmann::ordered_json& row);

}  // namespace hooke::app
