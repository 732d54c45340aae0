// A mesh and what several of its measures need alike.
#pragma once

#include "hooke/bounding_volume_tree.h"
#include "hooke/connectivity.h"
#include "hooke/extent.h"

namespace hooke {

/// Keeps a reference to the connectivity, which must outlive it, and its own copy of the points.
struct MeasuredSurface {
  /// `tree_order`: tree.order() of a surface with the same connectivity, whose faces lie about the same,
  /// saves the time to find one.
  MeasuredSurface(Mat3X points, const Connectivity& connectivity, const std::vector<int>& tree_order = {});

  Mat3X points;
  const Connectivity& connectivity;
  Extent extent;
  BoundingVolumeTree tree;  // over the faces
};

/// All vertices that have a face, once each, as the tree first comes upon them: loops in this order find what
/// they need in the cache, however the file was ordered.
std::vector<int> vertices_in_tree_order(const MeasuredSurface& surface);

}  // namespace hooke
