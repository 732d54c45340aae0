// Polygon File Format of Stanford: text and binary of both byte orders.
// Source: Greg Turk, "The PLY Polygon File Format", Stanford University, 1994.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hooke/io/mesh_file.h"

namespace hooke {

/// Reads x, y, z and all other scalar properties of the element `vertex` and the list vertex_indices (or
/// vertex_index) of the element `face`, of any types, in any order; NaN and infinities only in the other
/// properties. Lists of vertices, more of faces and other elements are not kept: one warning says which.
/// Throws InputError "NAME:LINE: ...", for a binary body "NAME: ELEMENT ROW, byte OFFSET: ...", also for
/// bytes after the last element.
MeshFile read_ply(std::string_view bytes, const std::string& name);

/// Coordinates as double, corners as int, and the channels of the data as what they are; numbers read back as
/// exactly the same in every encoding.
std::string write_ply(Eigen::Ref<const Mat3X> points, const std::vector<Triangle>& triangles,
                      PlyEncoding encoding = PlyEncoding::binary_little_endian, const VertexData& data = {});

// Target lengths out of a PLY file.

/// Reads target lengths, one per vertex, from the float or double vertex property of that name. Throws
/// InputError as read_ply() does, also when there is no such property, naming those there are, and for a
/// value that is not positive. What follows the vertices in the file is not looked at.
std::vector<double> read_ply_lengths(std::string_view bytes, const std::string& name,
                                     const std::string& property);

}  // namespace hooke
