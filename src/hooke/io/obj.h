// Reader and writer of Wavefront OBJ: vertices, faces and vertex data. Warns of all other content.
// Source: Wavefront Technologies, "Advanced Visualizer Manual, Appendix B1: Object Files (.obj)", 1990s.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hooke/io/mesh_file.h"
#include "hooke/io/scanner.h"

namespace hooke {

/// Reads `v` (3 numbers; a fourth must be 1; six include a colour, kept if all vertices have one) and `f` (v,
/// v/vt, v//vn, v/vt/vn; negative indices count back from the last element so far; positive ones may refer to
/// later elements). Texture coordinates (s, t, p of the vertex data) and normals are kept if each vertex has
/// the same values at all its corners; otherwise the warning `texture_seams` or `hard_edges` names the
/// vertices. Groups, materials, lines and unknown statements are not kept; one warning lists them. Throws
/// InputError "NAME:LINE: ...", but not for invalid numbers in `vt` and `vn`, which are then not kept.
MeshFile read_obj(std::string_view text, const std::string& name);

/// Elements of one kind in an OBJ file, as they stand there, and those of its face corners.
struct ObjCornerData {
  Mat3X values;                 // of all elements; missing and broken numbers as they come
  std::vector<int> of_corners;  // column of each corner, in the order of the polygons' items; -1 for none.
                                // Empty if there are no elements
};

/// What an OBJ file says of its face corners.
struct ObjCorners {
  Mat3X points;       // of the vertices
  IntLists polygons;  // vertex ids of each face
  ObjCornerData texture, normals;
};

/// Reads vertices, faces and the data of face corners. Throws what read_obj() throws.
ObjCorners read_obj_corners(std::string_view text, const std::string& name);

/// The syntax of OBJ texts.
inline constexpr Scanner::Syntax obj_syntax = {.comments = true, .continuations = true};

/// The text of an OBJ file with `v`, `vt`, `vn` and `f` lines. Numbers read back exactly. Of the data it
/// holds colours, texture coordinates and normals.
std::string write_obj(Eigen::Ref<const Mat3X> points, const std::vector<Triangle>& triangles,
                      const VertexData& data = {});

}  // namespace hooke
