// SHA-256 hashes of the bytes of a file and of the faces of a mesh, for the report.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hooke/core/types.h"

namespace hooke {

/// SHA-256 of the bytes as 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

/// SHA-256 of the vertex ids of the faces, in order, as little-endian 32-bit integers.
std::string connectivity_sha256(const std::vector<Triangle>& faces);

}  // namespace hooke
