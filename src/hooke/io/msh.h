// Reader and writer of Gmsh's mesh files (MSH): the surface triangles, with their physical groups.
// Source: C. Geuzaine, J.-F. Remacle, "Gmsh reference manual", section "MSH file format".
#pragma once

#include <string>
#include <string_view>

#include "hooke/io/mesh_file.h"

namespace hooke {

/// Reads versions 2.0 to 2.2 and 4.1, text and binary, of either byte order. Triangles and quadrangles are
/// the polygons; the nodes that they use are the vertices, in file order, whatever their numbers are. The
/// physical groups of the polygons, with their names, and their geometrical entities are the face data
/// `group` and `entity`, 0 for none. Other elements, other nodes and other sections are not kept; one warning
/// counts them. Throws InputError "NAME:LINE: ...", or "NAME: byte OFFSET: ..." in binary sections.
MeshFile read_msh(std::string_view bytes, const std::string& name);

/// The text of a file of version 4.1, or 2.2 for MeshFormat::msh2, with the groups and entities in the data.
/// Nodes and elements are numbered from 1, in their order. All numbers read back exactly.
std::string write_msh(const Eigen::Ref<const Mat3X>& points, const std::vector<Triangle>& triangles,
                      MeshFormat version = MeshFormat::msh, const FaceData& data = {});

}  // namespace hooke
