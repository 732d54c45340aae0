// The map of a result onto its input, as a text.
#pragma once

#include <string>

#include "hooke/mesh/surface_point.h"

namespace hooke {

/// One line per vertex of the result: the vertex of the input that it was, or -1; a face of the input, or -1;
/// and the barycentric weights of that face's corners, in their order there. Ids count from 0; triangles of a
/// polygon count one by one.
std::string map_text(const std::vector<MapEntry>& map);

}  // namespace hooke
