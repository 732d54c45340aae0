// Reader and writer of Wavefront OBJ: vertices, faces and vertex data. Warns of all other content.
// Source: Wavefront Technologies, "Advanced Visualizer Manual, Appendix B1: Object Files (.obj)", 1990s.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hooke/io/mesh_file.h"
#include "hooke/io/scanner.h"
#include "hooke/mesh/corner_data.h"

namespace hooke {

/// Reads `v` (3 numbers; a fourth must be 1; six include a colour, kept if all vertices have one) and `f` (v,
/// v/vt, v//vn, v/vt/vn; negative indices count back from the last element so far; positive ones may refer to
/// later elements). Texture coordinates (s, t, p of the vertex data) and normals are vertex data if each
/// vertex has the same values at all its corners, else data of corners. `usemtl`, `g`, `o` and `s` are face
/// data, `mtllib` is kept as it is. Lines and unknown statements are not kept; one warning lists them. Throws
/// InputError "NAME:LINE: ...", but not for invalid numbers in `vt` and `vn`, which are then not kept.
MeshFile read_obj(std::string_view text, const std::string& name);

/// What an OBJ file says of its face corners.
struct ObjCorners {
  Mat3X points;                     // of the vertices
  IntLists polygons;                // vertex ids of each face
  PolygonCorners texture, normals;  // numbers as they stand there, missing and broken ones too
};

/// Reads vertices, faces and the data of face corners. Throws what read_obj() throws.
ObjCorners read_obj_corners(std::string_view text, const std::string& name);

/// The syntax of OBJ texts.
inline constexpr Scanner::Syntax obj_syntax = {.comments = true, .continuations = true};

/// What an OBJ file holds beside points and triangles.
struct ObjData {
  const VertexData& vertices;  // colours, and texture coordinates and normals unless corners have these
  const FaceData& faces;       // material, group, object and smoothing group
  const CornerData& corners;
  const std::vector<std::string>& material_libraries;
};

/// The text of an OBJ file with `v`, `vt`, `vn` and `f` lines. Numbers read back exactly. Of the data it
/// holds colours, texture coordinates and normals.
std::string write_obj(const Eigen::Ref<const Mat3X>& points, const std::vector<Triangle>& triangles,
                      const VertexData& data = {});

/// The same with data of faces and corners: `mtllib` lines, and where they change from face to face `o`, `g`,
/// `usemtl` and `s` lines. A label without a name gets one from its number.
std::string write_obj(const Eigen::Ref<const Mat3X>& points, const std::vector<Triangle>& triangles,
                      const ObjData& data);

}  // namespace hooke
