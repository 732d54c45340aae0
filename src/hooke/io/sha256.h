// Fingerprint of a file's bytes, for the report.
#pragma once

#include <string>
#include <string_view>

namespace hooke {

/// SHA-256 of the bytes as 64 lower-case hex digits.
std::string sha256(std::string_view bytes);

}  // namespace hooke
