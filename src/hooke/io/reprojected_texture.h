// Texture coordinates of an OBJ file that follow its vertices: each takes the value that the texture had, on
// its side of a seam, where the vertex is now.
#pragma once

#include <vector>

#include "hooke/core/lists.h"
#include "hooke/core/types.h"
#include "hooke/mesh/surface_point.h"

namespace hooke {

/// The old texture coordinates and where the vertices went.
struct TextureMotion {
  const IntLists& polygons;
  const std::vector<int>& elements;  // of the corners: a column of `values`, -1 for none
  const Mat3X& values;               // texture coordinates of the file
  const Mat3X& before;               // the vertices
  const Mat3X& after;
  const std::vector<MapEntry>&
      map;  // of the vertices to the triangles that triangulate() makes of the polygons
};

struct ReprojectedTexture {
  Mat3X values;             // one column per element of the file
  std::vector<char> moved;  // whether it differs from the old one
  int torn = 0;  // elements shared by vertices that now need different ones; they keep the old value
};

/// Interpolates linearly in the triangle where a vertex is now, if that triangle has texture coordinates of
/// the same chart (connected by polygons without a seam). A vertex that has crossed a seam extrapolates from
/// the triangle of its own chart that fits best.
ReprojectedTexture reproject_texture(const TextureMotion& motion);

}  // namespace hooke
