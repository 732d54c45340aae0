// Arrays of numbers in the XML files of VTK: text, base64 or raw bytes, with and without compression.
// Source: W. Schroeder, K. Martin, B. Lorensen, "The Visualization Toolkit", chapter "VTK File Formats".
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hooke {

/// How the binary arrays of a file are stored.
struct VtkEncoding {
  bool big_endian = false;
  bool long_sizes = false;  // sizes in front of the arrays have 64 bits instead of 32
  bool compressed = false;  // by zlib, in blocks
};

/// The bytes of text in base64. Blanks are ignored; padding may stand in the middle, where a second text
/// begins. Throws Error "problem; expected" for other characters.
std::string decode_base64(std::string_view text);

/// The content of an array that begins the bytes with its size. Throws Error "problem; expected" if the bytes
/// are truncated or the compressed blocks damaged.
std::string unpack_vtk_array(std::string_view bytes, const VtkEncoding& encoding);

/// The numbers in the content of an array. `type` is VTK's name, such as Float32. Throws Error "problem;
/// expected" for unknown types and sizes that do not fit.
std::vector<double> reals_of(std::string_view content, const std::string& type, bool big_endian);
std::vector<long long> integers_of(std::string_view content, const std::string& type, bool big_endian);

}  // namespace hooke
