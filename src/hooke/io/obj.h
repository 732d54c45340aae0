// Wavefront OBJ: vertices, faces, and what belongs to vertices; all else is passed over with a warning.
// Source: Wavefront Technologies, "Advanced Visualizer Manual, Appendix B1: Object Files (.obj)", 1990s.
#pragma once

#include <string>
#include <string_view>

#include "hooke/io/mesh_file.h"

namespace hooke {

/// Reads `v` (3 numbers; a fourth must be 1; six: with a colour, kept when all vertices have one) and `f` (v,
/// v/vt, v//vn, v/vt/vn; negative indices count back from the last element so far; positive ones may point
/// forward). Texture coordinates (s, t, p of the vertex data) and normals are kept when each vertex has the
/// same in all its corners; where it has several, the warning `texture_seams` or `hard_edges` names the
/// places. Groups, materials, lines and unknown statements are not kept: one warning says what is not.
/// Throws InputError "NAME:LINE: ...", but not for broken numbers of `vt` and `vn`: those are not kept.
MeshFile read_obj(std::string_view text, const std::string& name);

/// `v`, `vt`, `vn` and `f` lines whose numbers read back as exactly the same; of the data colours, texture
/// coordinates and normals.
std::string write_obj(Eigen::Ref<const Mat3X> points, const std::vector<Triangle>& triangles,
                      const VertexData& data = {});

}  // namespace hooke
