#include "hooke/measure/measured_surface.h"

#include <utility>

namespace hooke {

MeasuredSurface::MeasuredSurface(Mat3X own_points, const Connectivity& its_connectivity,
                                 const MeshIds& mesh_ids, const std::vector<int>& tree_order)
    : points(std::move(own_points)),
      connectivity(its_connectivity),
      ids(mesh_ids),
      extent(measure_extent(points, connectivity)),
      tree(points, connectivity.faces, tree_order) {}

}  // namespace hooke
