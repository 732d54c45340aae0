// Nearest-face queries for many points at once.
#pragma once

#include <memory>

#include "hooke/geometry/aabb_tree.h"

namespace hooke {

struct NearestFace {
  double squared_distance = 0;  // bitwise equal to that of closest_point() for this face
  long long index = -1;         // index in faces() of the tree; -1 if the tree is empty
};

/// Keeps a reference to the tree, which must outlive it. Use one object per thread. Which of several equally
/// close faces is returned depends on earlier queries.
class NearestFaceSearch {
 public:
  explicit NearestFaceSearch(const AabbTree& tree);
  ~NearestFaceSearch();

  /// Finds the nearest face of each point; among faces at the same distance up to rounding, any of them. Fast
  /// if consecutive points are close in space: the candidates are collected for many points together and
  /// tested for four points at a time.
  /// Pre-condition: as many results as points.
  void operator()(std::span<const Vec3> points, std::span<NearestFace> results);

  struct Packet;
  struct Candidates;

 private:
  void find(std::span<const Vec3> points, std::span<NearestFace> results);
  bool find_together(Packet& packet);
  bool test_candidates(double beyond, double within, Packet& packet);

  const AabbTree& tree_;
  std::unique_ptr<Candidates> candidates_;
  double expected_ = 0;  // squared distance, from the last points
};

}  // namespace hooke
