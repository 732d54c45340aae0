// Polygons cut into triangles by ear clipping.
// Source: G. H. Meisters, "Polygons have ears", American Mathematical Monthly 82 (1975).
#pragma once

#include <string>
#include <vector>

#include "hooke/core/types.h"
#include "hooke/mesh/adjacency.h"

namespace hooke {

struct TriangulatedPolygons {
  std::vector<Triangle> triangles;  // those of a polygon stand together, polygons in their order
  std::vector<int> polygon;         // from which each triangle was cut
  int polygons_cut = 0;             // polygons with more than three corners
  int not_simple = 0;  // of these, the ones without a clean cut: crossing or folded sides, no area
};

/// Cuts every polygon with n corners into n - 2 triangles of the same orientation, in the plane of its Newell
/// normal, best-shaped ears first; a quadrilateral is cut along the diagonal whose worse triangle is the
/// better one. In a simple polygon no triangle is flipped, and none has zero area unless corners coincide.
/// Time grows with the square of a polygon's concave corners: 1.4 s for a star of 20 000.
/// Pre-condition: corners are columns of `points`, three or more a polygon.
TriangulatedPolygons triangulate(const Mat3X& points, const IntLists& polygons);

/// The warnings `polygons_triangulated` and `polygons_not_simple` of that, none if nothing was cut.
Warnings warnings_of(const TriangulatedPolygons& triangulation, const std::string& name);

}  // namespace hooke
