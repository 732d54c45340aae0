// What made an output, in a hidden file beside it, so that --skip-existing knows what is done.
#pragma once

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

#include "batch_plan.h"

namespace hooke::app {

/// SHA-256 of all that decides on the result of the task: the content of the input and of files that options
/// name, the options, and this program. Empty if a file cannot be read.
std::string work_hash(const Settings& settings, const MeshTask& task);

/// The row of the table that a run of this hash has left, if all its outputs are there and as it wrote them.
std::optional<nlohmann::ordered_json> row_if_done(const MeshTask& task, const std::string& hash);

/// Writes down that the task is done. Throws OutputError.
void record_done(const MeshTask& task, const std::string& hash, const nlohmann::ordered_json& row);

}  // namespace hooke::app
