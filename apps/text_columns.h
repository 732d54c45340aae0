// Text in lines of the width of a terminal.
#pragma once

#include <string>
#include <string_view>

namespace hooke::app {

inline constexpr std::size_t terminal_columns = 80;

/// The words of the text in lines of at most 80 columns, each but the first after `indent` spaces; the first
/// begins at column `begin`. No line break at the end.
std::string wrapped(std::string_view text, std::size_t indent = 0, std::size_t begin = 0);

}  // namespace hooke::app
