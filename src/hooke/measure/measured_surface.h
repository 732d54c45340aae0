// A mesh and what several of its measures need alike.
#pragma once

#include "hooke/geometry/aabb_tree.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/extent.h"
#include "hooke/mesh/memory_order.h"

namespace hooke {

/// Keeps a reference to the connectivity and to the lists of ids, which must outlive it, and its own copy of
/// the points.
struct MeasuredSurface {
  /// `ids`: those by which measures name vertices and faces. `tree_order`: tree.order() of a surface with the
  /// same connectivity, whose faces lie about the same, saves the time to find one.
  MeasuredSurface(Mat3X points, const Adjacency& adjacency, const MeshIds& ids = {},
                  const std::vector<int>& tree_order = {});

  Mat3X points;
  const Adjacency& adjacency;
  MeshIds ids;
  Extent extent;
  AabbTree tree;  // over the faces
};

}  // namespace hooke
