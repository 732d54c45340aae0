// Gradation: how fast target lengths may grow from vertex to vertex.
// H. Borouchaki, F. Hecht, P. J. Frey, "Mesh gradation control", 1998.
#pragma once

#include "hooke/mesh/connectivity.h"

namespace hooke {

/// Lowers target lengths until along every edge they differ by at most `slope` times the edge's length; the
/// greatest lengths that do and are nowhere above the given ones. Infinity limits nothing.
/// Pre-condition: slope is positive.
void limit_gradation(const Mat3X& points, const Connectivity& connectivity, double slope,
                     std::vector<double>& vertex_length);

}  // namespace hooke
