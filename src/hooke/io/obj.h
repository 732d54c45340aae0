// Wavefront OBJ: vertices and faces; everything else is passed over with a warning.
// Source: Wavefront Technologies, "Advanced Visualizer Manual, Appendix B1: Object Files (.obj)", 1990s.
#pragma once

#include <string>
#include <string_view>

#include "hooke/io/mesh_file.h"

namespace hooke {

/// Reads `v` (3 numbers; a fourth must be 1; six: with a colour, kept when all vertices have one) and `f` (v,
/// v/vt, v//vn, v/vt/vn; negative indices count back from the last element so far; positive ones may point
/// forward). Texture and normal indices are checked too. Texture coordinates, normals, groups, materials,
/// lines and unknown statements are not kept: one warning says which. Throws InputError "NAME:LINE: ...".
MeshFile read_obj(std::string_view text, const std::string& name);

/// `v` and `f` lines whose numbers read back as exactly the same. `data`: none, or red, green and blue.
std::string write_obj(Eigen::Ref<const Mat3X> points, const std::vector<Triangle>& triangles,
                      const VertexData& data = {});

}  // namespace hooke
