// A file of target lengths, one a line.
#pragma once

#include <filesystem>
#include <vector>

namespace hooke {

/// Reads `count` positive numbers, one a line; '#' starts a comment. Throws InputError with the line for
/// anything else, and when there are more or fewer.
std::vector<double> read_length_list(const std::filesystem::path& path, int count);

}  // namespace hooke
