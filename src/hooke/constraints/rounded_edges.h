// Rounded edges: where the surface of a part turns within a target length from one side to another, as in
// fillets and rounds that are narrow for the length.
#pragma once

#include <vector>

#include "hooke/mesh/adjacency.h"

namespace hooke {

/// Lines of edges along the middle of rounded edges: each divides the faces that are turned rather as one
/// side from those turned rather as the other, where these turn from each other by more than `sharp_angle`,
/// in degrees. Sides are parts of the surface that bend little within a target length, given at each edge,
/// and are not narrow for it. The faces between them are shared out by a watershed (S. Beucher and
/// C. Lantuejoul 1979) of the angles from the sides. Lines do not cross `creases`, which are marked by edge.
std::vector<Edge> middles_of_rounded_edges(const Mat3X& points, const Adjacency& adjacency,
                                           const std::vector<double>& edge_length, double sharp_angle,
                                           const std::vector<char>& creases);

}  // namespace hooke
