// Triangles in any arrangement, made an oriented manifold: which faces are neighbours at each edge, which way
// they are oriented, and where vertices have to be split. Source for edges between solids: A. Gueziec, G.
// Taubin, F. Lazarus, W. Horn, "Cutting and stitching: converting sets of polygons to manifold surfaces",
// IEEE TVCG 7 (2001).
#pragma once

#include <vector>

#include "hooke/core/types.h"

namespace hooke {

struct Sheets {
  std::vector<Triangle> triangles;  // in the same order
  std::vector<int> source;          // old vertex of each vertex; the first are the old vertices
  // What was done, in old ids:
  std::vector<Edge> cut_edges;      // of three faces or more, of which at most two are neighbours now
  std::vector<Edge> guessed_edges;  // of these, where faces do not alternate as around solids
  std::vector<Edge> opened_edges;   // where a one-sided surface was cut open
  std::vector<int> split_vertices;  // of these, those that are not on such edges
  std::vector<int> flipped_faces;   // ascending
};

/// What becomes of the faces at edges of three faces or more.
enum class ManyFaces {
  paired,  // those that belong together are neighbours
  apart,   // all are cut apart
};

/// At edges of two faces these are neighbours. At others the faces around a solid are, if faces alternate in
/// their direction along the edge; else those that continue each other best, in pairs. Of the faces that hang
/// together the fewer are flipped. Each vertex is split so that the faces around it are one fan of
/// neighbours. Of two faces back to back each is the wall of one solid.
/// Pre-condition: the corners of a triangle differ; if two have the same three, the result may be invalid.
Sheets make_sheets(const Mat3X& points, const std::vector<Triangle>& triangles,
                   ManyFaces many_faces = ManyFaces::paired);

}  // namespace hooke
