// A mesh with the data that several measures share: ids, extent and a tree of its faces.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "hooke/geometry/aabb_tree.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/extent.h"
#include "hooke/mesh/junctions.h"
#include "hooke/mesh/memory_order.h"

namespace hooke {

/// Keeps a reference to the adjacency and views of the id lists, which must outlive it, and its own copy of
/// the points.
struct MeasuredSurface {
  /// `ids` are those that the measures report for vertices and faces. `tree_order`, the tree.order() of a
  /// surface with the same connectivity and similar geometry, saves the time of building one.
  /// `joined`: of sheets that are measured as one mesh, by the vertices of the adjacency, see junctions.h.
  MeasuredSurface(Mat3X points, const Adjacency& adjacency, const MeshIds& ids = {},
                  const std::vector<int>& tree_order = {}, std::vector<int> joined = {});

  Mat3X points;
  const Adjacency& adjacency;
  MeshIds ids;
  std::vector<int> joined;
  Extent extent;
  AabbTree tree;  // over the faces, with their vertices joined

  /// Tells which shell (see mesh/junctions.h) each vertex is of, by numbers of [0, count): the same ones in a
  /// result and its reference, either of which knows them or neither. Measures compare a vertex or a face
  /// that seems wrong with its own shell where another one is nearer.
  void set_shells(std::vector<int> of_vertices, int count);
  /// 0 where they are not known.
  int shell_count() const { return static_cast<int>(shell_trees_.size()); }
  /// Of both: -1 where it is not known.
  int shell_of_vertex(int vertex) const { return shells_.empty() ? -1 : shells_[vertex]; }
  int shell_of_face(int face) const { return shell_of_vertex(adjacency.faces[face][0]); }
  /// The tree of the faces of a shell, with the ids that they have in the whole; of all faces for -1.
  const AabbTree& tree_of(int shell) const { return shell < 0 ? tree : shell_trees_[shell]; }

  /// find_self_intersections() of the tree, which only the first call looks for. Not thread-safe.
  const std::vector<std::array<int, 2>>& self_intersections() const;

 private:
  std::vector<int> shells_;  // per vertex
  std::vector<AabbTree> shell_trees_;
  mutable std::optional<std::vector<std::array<int, 2>>> self_intersections_;
};

}  // namespace hooke
