// Object File Format of Geomview: vertices and faces in text.
// Source: The Geometry Center, "Geomview Manual", section "OFF: Object File Format".
#pragma once

#include <string>
#include <string_view>

#include "hooke/io/mesh_file.h"

namespace hooke {

/// Reads OFF, with ST, C and N before it or without any keyword; one vertex or face on a line, the edge count
/// may be left out. Normals, colours and texture coordinates are not kept: one warning says which. Throws
/// InputError "NAME:LINE: ...", also for 4OFF, nOFF and binary files, and for text after the last face.
MeshFile read_off(std::string_view text, const std::string& name);

/// A plain OFF file whose numbers read back as exactly the same.
std::string write_off(Eigen::Ref<const Mat3X> points, const std::vector<Triangle>& triangles);

}  // namespace hooke
