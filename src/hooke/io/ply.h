// Reader and writer of the Stanford Polygon File Format (PLY), as text and binary in both byte orders.
// Source: Greg Turk, "The PLY Polygon File Format", Stanford University, 1994.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hooke/io/mesh_file.h"

namespace hooke {

/// Reads x, y, z and all other scalar properties of the element `vertex` and the list vertex_indices (or
/// vertex_index) of the element `face`, of any types and in any order, and the integer properties of that as
/// face data. NaN and infinity are allowed in vertex properties other than the coordinates. Lists of
/// vertices, other properties of faces and other elements are not kept; one warning lists them. Throws
/// InputError "NAME:LINE: ...", or "NAME: ELEMENT ROW, byte OFFSET:
/// ..." for a binary body, also for bytes after the last element.
MeshFile read_ply(std::string_view bytes, const std::string& name);

/// The bytes of a PLY file with coordinates as double, corners as int, and the channels of the data, one
/// value per vertex, and of the faces' data, one per triangle, in their own types. Numbers read back exactly
/// in every encoding.
std::string write_ply(const Eigen::Ref<const Mat3X>& points, const std::vector<Triangle>& triangles,
                      PlyEncoding encoding = PlyEncoding::binary_little_endian, const VertexData& data = {},
                      const VertexData& face_data = {});

/// Face data as channels of write_ply().
VertexData ply_face_data(const FaceData& data);

/// Reads target lengths, one per vertex, from the float or double vertex property of that name. Throws
/// InputError like read_ply(), also if there is no such property, naming the existing ones, and for values
/// that are not positive. The file is not read beyond the vertices.
std::vector<double> read_ply_lengths(std::string_view bytes, const std::string& name,
                                     const std::string& property);

}  // namespace hooke
