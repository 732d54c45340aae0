// All bytes of a regular file.
#pragma once

#include <filesystem>
#include <string_view>

#include "hooke/core/unfilled_vector.h"

namespace hooke {

struct FileBytes {
  UnfilledVector<char> bytes;

  std::string_view text() const& { return {bytes.data(), bytes.size()}; }
  std::string_view text() const&& = delete;  // it would outlive them
};

/// Throws InputError if the file is missing, not a regular file (a folder, a pipe, a device ...), empty or
/// unreadable, and LimitError if it does not fit in memory. Never blocks on a pipe.
FileBytes read_regular_file(const std::filesystem::path& path);

}  // namespace hooke
