// Reader and writer of STL, text and binary: triangles without connectivity.
// Source: 3D Systems, "StereoLithography Interface Specification", 1988-1989.
#pragma once

#include <string>
#include <string_view>

#include "hooke/io/mesh_file.h"

namespace hooke {

/// Whether the bytes are as long as a binary STL file with the number of facets in its header. Such a file is
/// binary even if it begins with the word `solid`.
bool is_binary_stl(std::string_view bytes);

/// Reads facets. Corners with equal coordinates (-0 equals 0) become one vertex; vertices are numbered in the
/// order of their first corners, and a note counts them. Keywords in upper or lower case; several solids,
/// whose numbers from 1 are the face data `group`, with their names. The 16 bits at each facet of a binary
/// file are the face data `attribute`, unless all are 0. Normals are ignored. Throws InputError "NAME:LINE:
/// ..." for text, "NAME: facet F, byte OFFSET: ..." for binary files, also if the number of facets in the
/// header does not match the size of the file.
MeshFile read_stl(std::string_view bytes, const std::string& name);

/// The bytes of an STL file, with the normals of its facets, zero for those without area. Text reads back
/// exactly, with a solid for each run of faces of one `group`. Binary files hold coordinates rounded to
/// 32-bit floats, the `attribute`, and the header, as long as it cannot be taken for text. Throws OutputError
/// if a coordinate is beyond the range of floats.
std::string write_stl(const Eigen::Ref<const Mat3X>& points, const std::vector<Triangle>& triangles,
                      PlyEncoding encoding, const FaceData& data = {}, const std::string& header = {});

/// What the mesh loses in an STL file: the warning `vertices_coincide` if different vertices of its faces
/// have the same coordinates there, so that a reader joins them; `faces_turned_by_rounding` if its numbers
/// of 32 bits turn faces over or take their area; `attributes_not_kept` if there are vertices
/// in no face. `name` is that of the output.
Warnings losses_in_stl(const Eigen::Ref<const Mat3X>& points, const std::vector<Triangle>& triangles,
                       PlyEncoding encoding, const std::string& name);

}  // namespace hooke
