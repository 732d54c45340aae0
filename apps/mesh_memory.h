// How much memory a run on a mesh file will take, before it is read.
#pragma once

#include <cstddef>
#include <filesystem>

#include "options.h"

namespace hooke::app {

/// An upper estimate of the peak in bytes, by the size of the file, its format, and the finer mesh that
/// `adapt` makes of it where the length is given in natural lengths.
std::size_t memory_for(const std::filesystem::path& mesh, const Settings& settings);

}  // namespace hooke::app
