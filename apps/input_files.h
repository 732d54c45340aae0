// The files that options name for reading, beside the meshes.
#pragma once

#include <filesystem>
#include <vector>

#include "options.h"

namespace hooke::app {

/// A file and the option that names it, such as "--fix".
struct NamedFile {
  const char* role;
  std::filesystem::path path;
};

/// The files whose content decides on the result or on the exit code, in a fixed order.
std::vector<NamedFile> data_files(const Settings& settings);

/// data_files() and the file of --config, whose settings stand among those given.
std::vector<NamedFile> option_files(const Settings& settings);

}  // namespace hooke::app
