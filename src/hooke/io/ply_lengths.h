// Target lengths out of a PLY file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hooke {

/// Reads target lengths, one per vertex, from the float or double vertex property of that name. Throws
/// InputError as read_ply() does, also when there is no such property, naming those there are, and for a
/// value that is not positive. What follows the vertices in the file is not looked at.
std::vector<double> read_ply_lengths(std::string_view bytes, const std::string& name,
                                     const std::string& property);

}  // namespace hooke
