// A file of vertex ids, one a line.
#pragma once

#include <filesystem>
#include <vector>

namespace hooke {

/// Reads 0-based ids, one a line; '#' starts a comment. Throws InputError with the line for anything else and
/// for ids that are not in [0, count).
std::vector<int> read_id_list(const std::filesystem::path& path, int count);

}  // namespace hooke
