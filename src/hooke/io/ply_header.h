// The header of a PLY file: which elements follow, and how their values are written.
// Source: Greg Turk, "The PLY Polygon File Format", Stanford University, 1994.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hooke/io/mesh_file.h"

namespace hooke {

using PlyType = NumberType;  // PLY has just these

/// Bytes of a value in a binary file.
size_t size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::int32;      // of the value, or of the entries of a list
  std::optional<PlyType> count_type;  // of a list's length; none for a scalar
};

struct PlyElement {
  std::string name;
  long long count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement>
      elements;     // in the order of the body; names differ, and so do those of their properties
  size_t size = 0;  // bytes up to the body
  int lines = 0;
};

/// Throws InputError "NAME:LINE: ...". Counts are not negative; whether the body holds that many is not known
/// yet.
PlyHeader read_ply_header(std::string_view text, const std::string& name);

/// The element of that name. Throws InputError "NAME: ..." without one.
const PlyElement& find_element(const PlyHeader& header, std::string_view element_name,
                               const std::string& name);

}  // namespace hooke
