// Reader of VTK's XML files of polygons (VTP). Source: as in vtk_arrays.h.
#pragma once

#include <string>
#include <string_view>

#include "hooke/io/mesh_file.h"

namespace hooke {

/// Reads points and polygons of all pieces; arrays as text, in base64 or appended (raw, base64), of either
/// byte order, with and without compression by zlib. Point data become values of the vertices, cell data
/// with an integer for each cell labels of the faces. Vertices, lines, strips and other data are not kept;
/// one warning lists them. Throws InputError "NAME:LINE: ...", also for other compressors, for a document
/// type, and for numbers of points and polygons that differ from those of the piece.
MeshFile read_vtp(std::string_view bytes, const std::string& name);

}  // namespace hooke
