// The nearest faces of many points at once.
#pragma once

#include <memory>

#include "hooke/geometry/aabb_tree.h"

namespace hooke {

struct NearestFace {
  double squared_distance = 0;  // to the last bit that of closest_point() for this face
  long long place = -1;         // in the faces() of the tree; -1 when it is empty
};

/// Keeps a reference to the tree. One thread each; what it tells of ties depends on what it was asked before.
class NearestFaceSearch {
 public:
  explicit NearestFaceSearch(const AabbTree& tree);
  ~NearestFaceSearch();

  /// For each point the nearest face; of those at the same distance up to rounding any. Fast where points
  /// that stand next to each other are close in space: they look for what is near to all of them together,
  /// and four at a time for their own nearest.
  void operator()(std::span<const Vec3> points, std::span<NearestFace> results);

  struct Packet;
  struct Candidates;

 private:
  void find(std::span<const Vec3> points, std::span<NearestFace> results);
  bool find_together(Packet& packet);
  bool try_faces(double beyond, double within, Packet& packet);

  const AabbTree& tree_;
  std::unique_ptr<Candidates> candidates_;
  double expected_ = 0;  // squared distance, by what was found last
};

}  // namespace hooke
