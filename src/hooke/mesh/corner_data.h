// Data of face corners, such as texture coordinates and normals: a vertex may have other values in each face.
#pragma once

#include <vector>

#include "hooke/core/types.h"

namespace hooke {

/// Values of one kind at the corners of triangles.
struct CornerValues {
  Mat3X values;                   // one column per value
  int width = 3;                  // how many of its numbers count; the others are 0
  std::vector<Triangle> corners;  // per face: the value of each corner, or -1 at all three for a face without

  bool empty() const { return corners.empty(); }
};

/// All that is known of the corners of the triangles of a mesh.
struct CornerData {
  CornerValues texture;  // texture coordinates
  CornerValues normals;

  bool empty() const { return texture.empty() && normals.empty(); }
};

/// The values of new faces, of which each takes those of an old face, corner by corner.
CornerData gather(const CornerData& data, const std::vector<int>& old_face);

}  // namespace hooke
