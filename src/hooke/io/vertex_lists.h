// A file of target lengths, one a line.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hooke/mesh/surface_point.h"

namespace hooke {

/// Reads `count` positive numbers, one a line; '#' starts a comment. Throws InputError with the line for
/// anything else, and when there are more or fewer.
std::vector<double> read_length_list(const std::filesystem::path& path, int count);

// A file of vertex ids, one a line.

/// Reads 0-based ids, one a line; '#' starts a comment. Throws InputError with the line for anything else and
/// for ids that are not in [0, count).
std::vector<int> read_id_list(const std::filesystem::path& path, int count);

// The map of a result onto its input, as a text.

/// One line per vertex of the result: the vertex of the input that it was, or -1; a face of the input, or -1;
/// and the barycentric weights of that face's corners, in their order there. Ids count from 0; triangles of a
/// polygon count one by one.
std::string map_text(const std::vector<MapEntry>& map);

}  // namespace hooke
