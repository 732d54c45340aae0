// Text files with one line per vertex or edge: target lengths, vertex ids, and the map of a result to its
// input.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hooke/mesh/surface_point.h"

namespace hooke {

/// Reads `count` positive target lengths, one per line; '#' starts a comment. Throws InputError with the line
/// number for anything else, and if there are more or fewer.
std::vector<double> read_length_list(const std::filesystem::path& path, int count);

/// The target length of an edge, as its line in a file tells it.
struct EdgeLength {
  Edge ends;
  double length = 0;  // positive
  int line = 0;       // number of the line, from 1
};

/// Reads lines of two different 0-based vertex ids and a positive length; '#' starts a comment. Throws
/// InputError with the line number for anything else and for ids outside [0, vertex_count).
std::vector<EdgeLength> read_edge_lengths(const std::filesystem::path& path, int vertex_count);

/// Reads 0-based vertex ids, one per line; '#' starts a comment. Throws InputError with the line number for
/// anything else and for ids outside [0, count).
std::vector<int> read_id_list(const std::filesystem::path& path, int count);

/// The map of a result to its input as text. One line per vertex of the result: its vertex id in the input or
/// -1; a face of the input or -1; and the barycentric weights of the corners of that face, in their order.
/// Ids are 0-based; each triangle of a polygon counts as a face.
std::string map_text(const std::vector<MapEntry>& map);

}  // namespace hooke
