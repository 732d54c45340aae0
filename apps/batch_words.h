// What a batch says about its meshes.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace hooke::app {

/// The status of a mesh whose run left no report.
std::string failure_word(int exit_code);

/// Whether a run with this exit code has written its result and a report.
bool leaves_a_report(int exit_code);

/// The last error in the messages of a run, without the name of the command; empty if there is none.
std::string last_error(const std::string& messages);

/// A line about a mesh, from its row of the table.
std::string row_in_words(const nlohmann::ordered_json& row);

/// How many meshes were done, skipped and not done, from the exit codes of all; without line break.
std::string batch_in_words(const std::vector<int>& codes, int skipped, double seconds);

}  // namespace hooke::app
