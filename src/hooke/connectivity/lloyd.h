// One step of Lloyd's method on a surface mesh: every vertex heads for the centroid of its Voronoi cell.
// S. P. Lloyd, "Least squares quantization in PCM", 1982; cells on meshes after Q. Du, V. Faber and M.
// Gunzburger, "Centroidal Voronoi tessellations", 1999.
#pragma once

#include "hooke/filter/retraction.h"

namespace hooke {

struct LloydOptions {
  double over_relaxation = 1.3;      // of the way to the centroid
  double boundary_relaxation = .91;  // of the way to the middle of the two neighbours on the boundary
  double max_move = .3;              // in target lengths
};

/// Where every vertex is to go; the caller makes that tangential and retracts. The cell is made of signed
/// kites between the vertex, the middles of its edges and the circumcentres of its faces; its density is
/// L^-4, which makes the lengths of the edges follow L. A vertex near an edge that is not Delaunay, or near a
/// boundary edge that faces an obtuse angle, has no such cell and takes the centroid of its faces. Vertices
/// on the boundary or a crease go along the line between their neighbours to where the two edges have the
/// ratio of their target lengths.
Mat3X lloyd_step(const Placement& placement, const Connectivity& connectivity,
                 const std::vector<double>& vertex_length, const LloydOptions& options);

}  // namespace hooke
