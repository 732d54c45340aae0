// Neighbourhoods on a mesh: the vertices around one vertex, as a surface would see them.
#pragma once

#include "hooke/core/types.h"
#include "hooke/mesh/connectivity.h"

namespace hooke {

/// Grows patches over mesh edges within the cone of normals about their centre. One patch at a time: what is
/// asked is about the last one grown.
class PatchGrower {
 public:
  /// `normals` are the unit vertex normals; `unfolded` tells where they mean something: on the outer side of
  /// all faces of the vertex. All arguments must outlive the grower.
  PatchGrower(const Eigen::Ref<const Mat3X>& points, const Connectivity& connectivity, const Mat3X& normals,
              const std::vector<char>& unfolded);

  /// Finds half as many vertices again as wanted by breadth-first search, keeps the nearest `size` of them
  /// and those that tie. What the search cuts off in the middle of a ring would leave the patch lopsided. The
  /// vertices stay in the order of the search, which knows nothing of coordinates.
  void grow(int centre, int size);

  const std::vector<int>& members() const { return members_; }         // the centre first
  const std::vector<double>& distances() const { return distances_; }  // from the centre
  double farthest() const { return farthest_; }                        // of the distances, ties aside

  /// Whether the patch holds the whole ring of the vertex, as far as the cone admits it.
  bool is_inside(int vertex) const;

 private:
  bool is_admitted(int vertex) const;
  Vec3 axis_at(int centre) const;
  void search(int centre, std::size_t most);

  Eigen::Ref<const Mat3X> points_;
  const Connectivity& connectivity_;
  const Mat3X& normals_;
  const std::vector<char>& unfolded_;
  Vec3 axis_ = Vec3::Zero();  // of the cone
  std::vector<int> met_by_;   // the last round whose search met the vertex
  std::vector<int> held_by_;  // the last round whose patch holds it
  std::vector<int> members_;
  std::vector<double> distances_;
  double farthest_ = 0;
  int round_ = -1;
};

}  // namespace hooke
