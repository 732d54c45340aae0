// The normals of a mesh file after its vertices were moved: of vertices, of face corners (OBJ), where hard
// edges stay hard, and of polygons.
#pragma once

#include <vector>

#include "hooke/core/lists.h"
#include "hooke/core/types.h"

namespace hooke {

/// New normals, one column per element of the file. Elements that are not renewed keep what the file says.
struct RenewedNormals {
  Mat3X values;               // unit normals of the renewed elements
  std::vector<char> renewed;  // whether anything about the element has moved and it has a normal
  int torn = 0;               // elements whose corners now have normals more than 10 degrees apart
};

/// The polygons of a file, before and after the vertices were moved.
struct MovedPolygons {
  const IntLists& polygons;
  const Mat3X& before;
  const Mat3X& after;
};

/// Normals that corners refer to. `elements` has the normal of each corner of the polygons, -1 for none;
/// `values` are the old normals. Corners of a vertex whose old normals are equal, or less than half a degree
/// apart, are of one smooth fan; its new normal sums the corners by Max's weights (see vertex_normals()). A
/// normal that several fans share becomes their mean. Polygons need not be triangles.
RenewedNormals renew_corner_normals(const MovedPolygons& moved, const std::vector<int>& elements,
                                    const Mat3X& values);

/// The same where each vertex has one normal.
RenewedNormals renew_vertex_normals(const MovedPolygons& moved);

/// Normals of polygons, by Newell's formula.
RenewedNormals renew_polygon_normals(const MovedPolygons& moved);

}  // namespace hooke
