// Fingerprints of a file's bytes and of a mesh's faces, for the report.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hooke/core/types.h"

namespace hooke {

/// SHA-256 of the bytes as 64 lower-case hex digits.
std::string sha256(std::string_view bytes);

/// SHA-256 of the faces' vertex ids as little-endian 32-bit integers.
std::string connectivity_sha256(const std::vector<Triangle>& faces);

}  // namespace hooke
