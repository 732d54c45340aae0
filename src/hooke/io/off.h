// Object File Format of Geomview: vertices and faces in text.
// Source: The Geometry Center, "Geomview Manual", section "OFF: Object File Format".
#pragma once

#include <string>
#include <string_view>

#include "hooke/io/mesh_file.h"

namespace hooke {

/// Reads OFF, with ST, C and N before it or without any keyword; one vertex or face on a line, the edge count
/// may be left out. After the coordinates come 3 numbers of a normal (N), 3 or 4 of a colour (C; up to 255 if
/// all are whole numbers) and 2 texture coordinates (ST). Other numbers of vertices and colours of faces are
/// not kept: one warning says which. Throws InputError "NAME:LINE: ...", also for 4OFF, nOFF and binary
/// files, and for text after the last face.
MeshFile read_off(std::string_view text, const std::string& name);

/// An OFF file whose numbers read back as exactly the same, with the normals, colours and texture coordinates
/// of the data.
std::string write_off(Eigen::Ref<const Mat3X> points, const std::vector<Triangle>& triangles,
                      const VertexData& data = {});

}  // namespace hooke
