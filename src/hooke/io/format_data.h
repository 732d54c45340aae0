// What of the data of vertices a file format can hold.
#pragma once

#include "hooke/mesh/vertex_data.h"

namespace hooke {

struct FormatData {
  VertexData data;
  std::vector<std::string> left_out;  // names of channels
};

/// Data that was read from one format, as another holds it: PLY any; OBJ colours, normals and texture
/// coordinates if finite; OFF these with an alpha, but no third texture coordinate. Colours of integer types
/// count up to the type's greatest value, others to 1; they become 8-bit ones, but in OBJ numbers from 0
/// to 1. The names texture_u and texture_v of PLY mean s and t.
FormatData data_for_format(const VertexData& data, const std::string& from, const std::string& to);

}  // namespace hooke
