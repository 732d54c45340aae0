// Text of unknown origin (file names, file content) made fit for a message.
#pragma once

#include <string>
#include <string_view>

namespace hooke {

/// The text with control characters and bytes that are not UTF-8 written as \n, \t, \x1b ...: one line, and
/// nothing that a terminal would obey.
std::string printable(std::string_view text);

/// 'text', printable and cut after 40 bytes.
std::string in_quotes(std::string_view text);

}  // namespace hooke
