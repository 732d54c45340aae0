// Narrow regions of a surface, strips and gaps between its creases and boundaries, and target lengths that
// fit into them.
#pragma once

#include <vector>

#include "hooke/mesh/adjacency.h"
#include "hooke/springs/placed_lengths.h"

namespace hooke {

/// The widths of narrow regions, across these and along them, as target lengths; `shortest`, which is
/// positive, where they are less. A region is narrow where two stretches of creases or boundaries face each
/// other across a smooth part of the surface, closer than the target length; stretches that lead into each
/// other nearby, as at a corner or around a disc, make none. A round crease or boundary whose radius is less
/// than that counts as such a region, as wide as the radius. `vertex_length`: target length per vertex, in
/// the unit of the points. `with_creases`: see split_wedges(). Time and memory grow with the length of narrow
/// regions over `shortest`.
std::vector<PlacedLength> lengths_of_narrow_regions(const Mat3X& points, const Adjacency& with_creases,
                                                    const std::vector<double>& vertex_length,
                                                    double shortest);

}  // namespace hooke
