// How far apart two spellings are, for messages that guess what was meant.
#pragma once

#include <cstddef>
#include <string_view>

namespace hooke {

/// How many letters must be put in, left out or replaced to make one word of the other.
std::size_t edit_distance(std::string_view a, std::string_view b);

}  // namespace hooke
