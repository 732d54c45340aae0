#include "hooke/measure/measured_surface.h"

#include <utility>

#include "hooke/geometry/self_intersection.h"

namespace hooke {

MeasuredSurface::MeasuredSurface(Mat3X own_points, const Adjacency& its_adjacency, const MeshIds& mesh_ids,
                                 const std::vector<int>& tree_order, std::vector<int> joined_vertices)
    : points(std::move(own_points)),
      adjacency(its_adjacency),
      ids(mesh_ids),
      joined(std::move(joined_vertices)),
      extent(measure_extent(points, adjacency)),
      tree(joined.empty() ? AabbTree(points, adjacency.faces, tree_order)
                          : AabbTree(points, join_faces(adjacency.faces, joined), tree_order)) {}

void MeasuredSurface::set_shells(std::vector<int> of_vertices, int count) {
  shells_ = std::move(of_vertices);
  std::vector<std::vector<int>> faces(count);
  for (const AabbTree::Face& face : tree.faces())
    if (const int shell = shell_of_face(face.id); shell >= 0) faces[shell].push_back(face.id);
  shell_trees_.clear();
  const std::vector<Triangle> none;  // as no order would stand for all faces
  for (const std::vector<int>& of_shell : faces)
    shell_trees_.emplace_back(points, of_shell.empty() ? none : adjacency.faces, of_shell);
}

const std::vector<std::array<int, 2>>& MeasuredSurface::self_intersections() const {
  if (!self_intersections_) self_intersections_ = find_self_intersections(tree);
  return *self_intersections_;
}

}  // namespace hooke
