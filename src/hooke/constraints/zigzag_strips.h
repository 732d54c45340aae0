// Zigzag strips: a twisted surface between two curves, as the side of a prism that is extruded with a twist,
// cut into needles that reach from one curve to the other. However many these are, the surface folds to and
// fro at their long sides, though it is meant to be smooth.
#pragma once

#include <vector>

#include "hooke/core/types.h"
#include "hooke/mesh/adjacency.h"

namespace hooke {

/// Marks, per edge, where zigzag strips fold: between needles, flat and of one face or more, whose points lie
/// at either curve by turns, which bend in and out by turns, by about the same angle of 120 degrees at most,
/// six or more in a row, and which the target length does not resolve. The normals of their faces become
/// those of the smooth strip: means of neighbours. `normals`: unit normal per face, zero without area.
/// `vertex_length`: target length at each vertex.
std::vector<char> smooth_zigzag_strips(const Mat3X& points, const Adjacency& adjacency,
                                       const std::vector<double>& vertex_length, Mat3X& normals);

}  // namespace hooke
