// What a run on several inputs is to do: for each mesh the arguments of a command of its own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "options.h"

namespace hooke::app {

/// One mesh of a batch.
struct MeshTask {
  std::filesystem::path input;
  std::filesystem::path output;                // empty with --check
  std::filesystem::path report;                // empty for none
  std::vector<std::filesystem::path> outputs;  // all files that it writes, the mesh first
  std::vector<std::string> method;             // options that decide on the result
  std::vector<std::string> arguments;          // of its command, without those of threads and messages
};

/// The tasks in the order of the inputs. Creates no file; to be called with settings of a batch. Throws Error
/// if two tasks would write the same file, or one an input, and for options that cannot serve several inputs.
std::vector<MeshTask> plan_batch(const Settings& settings);

/// Creates the folders that the tasks write to. Throws OutputError.
void create_folders(const std::vector<MeshTask>& tasks);

}  // namespace hooke::app
