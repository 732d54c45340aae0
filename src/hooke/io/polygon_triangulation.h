// Triangulation of polygons by ear clipping.
// Source: G. H. Meisters, "Polygons have ears", American Mathematical Monthly 82 (1975).
#pragma once

#include <string>
#include <vector>

#include "hooke/core/types.h"
#include "hooke/io/mesh_file.h"
#include "hooke/mesh/adjacency.h"

namespace hooke {

/// The triangles of a set of polygons.
struct TriangulatedPolygons {
  std::vector<Triangle> triangles;  // grouped by polygon, in the order of the polygons
  std::vector<int> polygon;         // the polygon of each triangle
  int polygons_cut = 0;             // number of polygons with more than three corners
  int not_simple = 0;               // of these, self-crossing, folded or without area
};

/// Cuts every polygon with n corners into n - 2 triangles of the same orientation, in the plane of its Newell
/// normal, best-shaped ears first. A quadrilateral is cut along the diagonal with the better worst triangle,
/// or from its first corner if both are about as good: rounding does not cut those of a grid in different
/// ways. In a simple polygon no triangle is flipped, and none has zero area unless corners coincide. Time is
/// quadratic in the number of concave corners of a polygon: 1.4 s for a star with 20 000 corners.
/// Pre-condition: corners are columns of `points`; every polygon has at least three.
TriangulatedPolygons triangulate(const Mat3X& points, const IntLists& polygons);

/// The items at the corners of the triangles, given one for each corner of the polygons, in their order.
std::vector<Triangle> items_of_triangles(const TriangulatedPolygons& triangulation, const IntLists& polygons,
                                         const std::vector<int>& of_corners);

/// The number of polygons with a corner that is concave in the plane of their Newell normal.
std::size_t count_concave(const Mat3X& points, const IntLists& polygons);

/// Whether the polygons make another surface where each is cut as a fan from its first corner, as simple
/// readers do: one with more than 1.25 times the area, because fans of concave polygons overlap.
bool misread_as_fans(const Mat3X& points, const IntLists& polygons,
                     const TriangulatedPolygons& triangulation);

/// Appends the warnings `polygons_triangulated`, which differs between a new file and a rewritten one, and
/// `polygons_not_simple`, if they apply; `name` is the file name.
void append_warnings(const TriangulatedPolygons& triangulation, const std::string& name,
                     ContentWarnings& content, Warnings& warnings);

}  // namespace hooke
