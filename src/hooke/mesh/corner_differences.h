// Differences of corner data between the two faces of an edge: where they make a seam, and where they only
// meet at a pole.
#pragma once

#include <vector>

#include "hooke/mesh/corner_data.h"
#include "hooke/mesh/mesh.h"

namespace hooke {

/// Compares the values of the faces of an edge, to within 1e-6 of the range of the values. A face without
/// values differs from one with them. Keeps references to both arguments; `values` are by face id of the
/// mesh. Vertices, edges and faces are in memory order.
class CornerDifferences {
 public:
  CornerDifferences(const MemoryOrder& memory_order, const CornerValues& values);

  /// The value of the face at this corner, -1 for none.
  int value_in(int face, int vertex) const;

  /// Do the faces of the inner edge have different values at this end?
  bool differ_at(int edge, int vertex) const;

  /// Poles, ascending: vertices where the values of nearly all edges differ, but at eight of
  /// them or more at that end only. Such are the texture coordinates at the poles of a sphere, where every
  /// face has its own.
  std::vector<int> find_poles() const;

 private:
  const MemoryOrder& memory_order_;
  const CornerValues& values_;
  Vec3 tolerance_ = Vec3::Zero();
};

}  // namespace hooke
