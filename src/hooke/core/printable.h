// Escapes text of unknown origin (file names, file content) for use in messages.
#pragma once

#include <string>
#include <string_view>

namespace hooke {

/// The text with control characters and bytes that are not UTF-8 escaped as \n, \t, \x1b ...: a single line
/// without terminal control sequences.
std::string printable(std::string_view text);

/// The printable text in single quotes, truncated after 40 bytes.
std::string in_quotes(std::string_view text);

}  // namespace hooke
