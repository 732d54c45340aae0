// A run of the command on a mesh in memory, without files: for bindings to other languages.
#pragma once

#include <nlohmann/json.hpp>

#include "hooke/mesh/valid_mesh.h"
#include "hooke/report/report.h"
#include "options.h"

namespace hooke::app {

/// Names of a mesh and its result in messages.
inline constexpr char input_name[] = "input";
inline constexpr char result_name[] = "result";

/// The settings that these options of the command give for a run in memory. Throws Error as parse_arguments()
/// does.
Settings memory_settings(std::vector<std::string> options);

/// Measures, optimizes and measures a mesh as the command does with a file: the result, which replaces the
/// mesh, is the same, bit by bit. With Settings::check only measures. The record has no path, hash and format
/// of files. The observer is called on this thread. Throws what the command makes an exit code of: Error for
/// lengths out of range, ResultError for a result that breaks a promise, LimitError, NumericalError,
/// InputError for files that options name.
RunRecord run_in_memory(Settings settings, ValidMesh& mesh, const Observer& observer = nullptr);

/// The report of the run; null for what only files have.
nlohmann::ordered_json report_of_memory(const RunRecord& record);

}  // namespace hooke::app
