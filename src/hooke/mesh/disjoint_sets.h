// Disjoint sets of vertices, joined by edges.
// R. E. Tarjan, "Efficiency of a good but not linear set union algorithm", 1975.
#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

#include "hooke/core/types.h"

namespace hooke {

/// Disjoint sets of the ids [0, count).
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  /// The id that stands for the set; the same one until sets are joined.
  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(const Edge& e) { parent_[root(e[0])] = root(e[1]); }

 private:
  std::vector<int> parent_;
};

}  // namespace hooke
