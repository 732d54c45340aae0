// All bytes of a regular file.
#pragma once

#include <filesystem>
#include <string>

namespace hooke {

/// Throws InputError if the file is missing, not a regular file (a folder, a pipe, a device ...), empty or
/// unreadable, and LimitError if it does not fit in memory. Never blocks on a pipe.
std::string read_regular_file(const std::filesystem::path& path);

}  // namespace hooke
