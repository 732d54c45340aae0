// Hard edges: where the normals of a file say that the surface is sharp, though it may be flat or round
// there.
#pragma once

#include <vector>

#include "hooke/mesh/corner_data.h"
#include "hooke/mesh/mesh.h"

namespace hooke {

struct HardEdges {
  std::vector<int> edges;  // of the adjacency, ascending; empty if the mesh is flat-shaded
  std::vector<Edge> ends;  // of these edges, as vertex ids of the mesh
  /// Each facet, a face or the triangles of a polygon, has a normal of its own: that says nothing about
  /// edges.
  bool is_flat_shaded = false;
};

/// Finds the inner edges whose faces have normals more than a degree apart at either end; at a pole of the
/// normals (see CornerDifferences), as at the apex of a cone, only the other end counts. The mesh is
/// flat-shaded if nearly all edges between facets are hard, by half a degree, and these are more than a third
/// of all. Faces without normals have no hard edges. `normals`: by face id of the mesh, may be empty.
HardEdges find_hard_edges(const MemoryOrder& memory_order, const CornerValues& normals);

}  // namespace hooke
