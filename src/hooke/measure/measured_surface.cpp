#include "hooke/measure/measured_surface.h"

#include <utility>

namespace hooke {

MeasuredSurface::MeasuredSurface(Mat3X own_points, const Adjacency& its_adjacency, const MeshIds& mesh_ids,
                                 const std::vector<int>& tree_order)
    : points(std::move(own_points)),
      adjacency(its_adjacency),
      ids(mesh_ids),
      extent(measure_extent(points, adjacency)),
      tree(points, adjacency.faces, tree_order) {}

}  // namespace hooke
