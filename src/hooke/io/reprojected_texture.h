// Texture coordinates of an OBJ file that follow its vertices: each takes the value that the texture had, on
// its side of a seam, where the vertex is now.
#pragma once

#include <vector>

#include "hooke/core/lists.h"
#include "hooke/core/types.h"

namespace hooke {

/// The old texture coordinates and where the vertices went.
struct TextureMotion {
  const IntLists& polygons;
  const std::vector<int>& elements;  // of the corners: a column of `values`, -1 for none
  const Mat3X& values;               // texture coordinates of the file
  const Mat3X& before;               // the vertices
  const Mat3X& after;
};

struct ReprojectedTexture {
  Mat3X values;             // one column per element of the file
  std::vector<char> moved;  // whether it differs from the old one
  int torn = 0;  // elements shared by vertices that now need different ones; they keep the old value
};

/// Interpolates linearly in the triangle where a vertex is now. The search for it starts at the faces of the
/// corner and goes on from face to face, nearer and nearer, but across no seam (an edge with different values
/// at either end): each corner stays on its own side, also where a chart borders on itself. A vertex that has
/// left its side extrapolates from the nearest triangle there, by an edge at most. Where a corner of a
/// polygon would turn over in the texture, its values stay. Pre-condition: the triangles of the polygons are
/// manifold and consistently oriented.
ReprojectedTexture reproject_texture(const TextureMotion& motion);

}  // namespace hooke
