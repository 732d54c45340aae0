// Faces of the input that stay in attempts to remesh it, as remeshing would not keep the input there.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "hooke/remesh/attempts.h"

namespace hooke {

/// At first none. Keeps a reference to the maker of the attempts. When it is destroyed, the faces are free
/// again; lengths that hold() has changed are not restored.
class KeptFaces {
 public:
  explicit KeptFaces(AttemptMaker& maker);
  ~KeptFaces();
  KeptFaces(const KeptFaces&) = delete;
  KeptFaces& operator=(const KeptFaces&) = delete;

  /// Adds those about the vertices of the input and `least_rings` around them, or twice as many rings as the
  /// last time if they or neighbours of theirs were kept already. Returns whether there are more now.
  bool add_around(const std::vector<int>& vertices, int least_rings);

  /// Their share of the input's area.
  double share_of_area() const;

  /// Lets them stay in the attempts to come; in mode `adapt` target lengths grow away from their edges.
  void hold();

 private:
  AttemptMaker& maker_;
  const std::vector<double> lengths_before_;
  const std::vector<int> frozen_before_;
  const Eigen::VectorXd mean_edges_;  // of the edges at each vertex of the input
  std::vector<int> rings_;  // per vertex of the input, the most rings that it was kept with; 0: not kept
};

}  // namespace hooke
