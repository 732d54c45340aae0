// What of the data of vertices a file format can hold.
#pragma once

#include "hooke/vertex_data.h"

namespace hooke {

struct FormatData {
  VertexData data;
  std::vector<std::string> left_out;  // names of channels
};

/// Data that was read from one format, as another holds it: PLY any, OBJ colours from 0 to 1, OFF none.
/// Colours of integer types count up to the type's greatest value; from OBJ they become 8-bit ones in PLY.
FormatData data_for_format(const VertexData& data, const std::string& from, const std::string& to);

}  // namespace hooke
