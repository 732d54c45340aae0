// Reader of binary OFF files: big-endian floats and 32-bit integers after the keyword line "OFF BINARY".
// Source: The Geometry Center, "Geomview Manual", section "OFF: Object File Format".
#pragma once

#include <string>
#include <string_view>

#include "hooke/io/mesh_file.h"
#include "hooke/io/off_format.h"

namespace hooke {

/// Where the vertices of a binary OFF file stand.
struct BinaryOffLayout {
  OffHeader header;
  size_t vertices = 0;     // offset of the first vertex
  size_t vertex_size = 0;  // bytes of each; the coordinates come first, then the normal
};

/// Throws InputError for counts that exceed the bytes that follow.
BinaryOffLayout binary_off_layout(std::string_view bytes, const std::string& name);

/// Reads the file as read_off() does; colours of vertices are four floats. Throws InputError "NAME: byte
/// OFFSET: ...".
MeshFile read_binary_off(std::string_view bytes, const std::string& name);

}  // namespace hooke
