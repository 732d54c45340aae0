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
  /// Per vertex: a number for the body that it belongs to, the same ones in a result as in its reference;
  /// empty where there is one body, or it is not known. Where bodies are close, a result is compared with its
  /// own.
  std::vector<int> bodies = {};

  int body_of_face(int face) const { return bodies[adjacency.faces[face][0]]; }
  /// The closest point on the faces of a body. Pre-condition: bodies are known.
  ClosestPoint closest_on_body(const Vec3& x, int body) const {
    return tree.closest(x, [&](int f) { return body_of_face(f) == body; });
  }

  /// find_self_intersections() of the tree, which only the first call looks for. Not thread-safe.
  const std::vector<std::array<int, 2>>& self_intersections() const;

 private:
  mutable std::optional<std::vector<std::array<int, 2>>> self_intersections_;
};

}  // namespace hooke
