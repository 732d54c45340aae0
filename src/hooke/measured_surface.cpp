#include "hooke/measured_surface.h"

#include <utility>

namespace hooke {

MeasuredSurface::MeasuredSurface(Mat3X own_points, const Connectivity& its_connectivity,
                                 const std::vector<int>& tree_order)
    : points(std::move(own_points)),
      connectivity(its_connectivity),
      extent(measure_extent(points, connectivity)),
      tree(points, connectivity.faces, tree_order) {}

std::vector<int> vertices_in_tree_order(const MeasuredSurface& surface) {
  std::vector<int> order;
  order.reserve(static_cast<size_t>(surface.connectivity.vertex_count));
  std::vector<char> seen(static_cast<size_t>(surface.connectivity.vertex_count), 0);
  for (const BoundingVolumeTree::Face& face : surface.tree.faces())
    for (int v : face.vertices)
      if (!std::exchange(seen[static_cast<size_t>(v)], 1)) order.push_back(v);
  return order;
}

}  // namespace hooke
