// Reader and writer of Geomview's Object File Format (OFF): vertices, faces and vertex data. Binary files are
// read only (binary_off.h). Source: The Geometry Center, "Geomview Manual", section "OFF: Object File
// Format".
#pragma once

#include <string>
#include <string_view>

#include "hooke/io/mesh_file.h"

namespace hooke {

/// Reads OFF with the prefixes ST, C and N, or without a keyword; one vertex or face per line; the edge count
/// may be missing. The coordinates are followed by a normal (N; 3 numbers), a colour (C; 3 or 4 numbers, up
/// to 255 if all are integers) and texture coordinates (ST; 2 numbers). Other numbers of vertices and the
/// colours of faces are not kept; one warning lists them. Throws InputError "NAME:LINE: ...", also for 4OFF
/// and nOFF, and for text after the last face.
MeshFile read_off(std::string_view text, const std::string& name);

/// The text of an OFF file with the normals, colours and texture coordinates in the data. All numbers read
/// back exactly.
std::string write_off(const Eigen::Ref<const Mat3X>& points, const std::vector<Triangle>& triangles,
                      const VertexData& data = {});

}  // namespace hooke
