// Axis-parallel boxes around triangles, as a binary tree: closest points and candidates for intersections.
#pragma once

#include <algorithm>
#include <bit>
#include <span>

#include "hooke/core/types.h"
#include "hooke/core/unfilled_vector.h"

namespace hooke {

struct ClosestPoint {
  Vec3 point = Vec3::Zero();
  double squared_distance = 0;
  int face = -1;  // the lowest id among equals that were visited; -1 when the tree is empty
};

/// Thinner triangles have no normal to speak of: their edges are as close as their inside. Doubled, over the
/// fourth power of the longest edge.
inline constexpr double least_triangle_squared_area = 1e-24;

/// Closest point of one triangle. Exact in the cases: a triangle without area is taken as its edges.
ClosestPoint closest_point(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c);

/// Weights of the corners at a point of the triangle, not negative, with sum 1.
Vec3 barycentric(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c);

/// Owns a copy of its triangles. Of faces at the same distance the order of faces() decides which one
/// is told; else answers depend on nothing but the triangles. Const calls are safe from several threads.
class BoundingVolumeTree {
 public:
  using Box = Eigen::AlignedBox3d;

  struct Face {
    std::array<Vec3, 3> corners;
    Triangle vertices;
    int id;

    Box box() const {
      return {corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]),
              corners[0].cwiseMax(corners[1]).cwiseMax(corners[2])};
    }
  };

  /// The faces are halved again and again down to the leaves. Node 1 is the root, and the children of node i
  /// are 2 i and 2 i + 1: a level stands together.
  static constexpr int max_depth = 32;

  /// A triangle may repeat a vertex id: it then stands for a segment. `order`, where given, becomes that of
  /// faces(): what is close there should be close in space.
  BoundingVolumeTree(const Mat3X& points, const std::vector<Triangle>& faces,
                     const std::vector<int>& order = {});

  bool empty() const { return faces_.empty(); }

  /// All faces along a curve that fills space: those that stand close here are close in space.
  std::span<const Face> faces() const { return faces_; }

  /// The ids of faces().
  std::vector<int> order() const;

  ClosestPoint closest(const Vec3& x) const;

  /// The boxes of all nodes, and the leaves among them.
  std::span<const Box> boxes() const { return boxes_; }
  size_t leaf_count() const { return boxes_.size() / 2; }
  bool is_leaf(size_t node) const { return node >= leaf_count(); }

  /// Place in faces() of the first face of a leaf, counted from 0. Those of leaf_count() follow the last.
  size_t first_face(size_t leaf) const { return (leaf * faces_.size()) >> depth_; }
  std::span<const Face> faces_of(size_t leaf) const {
    return faces().subspan(first_face(leaf), first_face(leaf + 1) - first_face(leaf));
  }

  /// Calls visit(leaf) for the leaves from `first` on, ascending, for whose boxes and those of all nodes
  /// above them reaches(box) is true.
  template <typename Reaches, typename Visit>
  void for_each_leaf(size_t first, const Reaches& reaches, const Visit& visit) const {
    size_t stack[max_depth + 1];
    int size = 0;
    stack[size++] = 1;
    while (size > 0) {
      const size_t i = stack[--size];
      const int level = static_cast<int>(std::bit_width(i)) - 1;
      const size_t leaves_end = ((i + 1) << (depth_ - level)) - leaf_count();
      if (leaves_end <= first || !reaches(boxes_[i])) continue;
      if (is_leaf(i)) {
        visit(i - leaf_count());
        continue;
      }
      stack[size++] = 2 * i + 1;
      stack[size++] = 2 * i;
    }
  }

  /// The pairs of faces whose boxes meet come in parts: with parts [begin, end) visit(f, g) is called for
  /// theirs. All parts together have each pair once.
  size_t parts() const { return (faces_.size() + faces_of_part - 1) / faces_of_part; }
  template <typename Visit>
  void for_each_meeting_pair(size_t begin, size_t end, const Visit& visit) const {
    for (size_t part = begin; part < end; ++part) visit_pairs(part * faces_of_part, visit);
  }

 private:
  static constexpr size_t leaf_size = 4;
  static constexpr size_t faces_of_part = 16;

  /// The boxes of a part, coordinate by coordinate.
  struct PartBoxes {
    std::array<std::array<double, faces_of_part>, 3> low, high;
    Box all;

    explicit PartBoxes(std::span<const Face> faces);

    /// Which of them meet another box: bit by bit.
    unsigned meeting(const Box& other) const;
  };

  /// The pairs of the faces of the part that begins at place `first` with later ones.
  template <typename Visit>
  void visit_pairs(size_t first, const Visit& visit) const {
    const PartBoxes boxes(faces().subspan(first, std::min(faces_of_part, faces_.size() - first)));
    for_each_leaf(
        (first << depth_) / faces_.size(), [&](const Box& box) { return box.intersects(boxes.all); },
        [&](size_t leaf) {
          for (size_t place = std::max(first_face(leaf), first + 1); place < first_face(leaf + 1); ++place) {
            unsigned meeting = boxes.meeting(faces_[place].box());
            if (place - first < faces_of_part) meeting &= (1U << (place - first)) - 1;
            for (; meeting != 0; meeting &= meeting - 1)
              visit(faces_[first + static_cast<size_t>(std::countr_zero(meeting))], faces_[place]);
          }
        });
  }

  void enclose(size_t node, int level);

  int depth_ = 0;               // levels below the root
  UnfilledVector<Face> faces_;  // leaf by leaf
  UnfilledVector<Box> boxes_;   // by node; that of node 0 is not used
};

}  // namespace hooke
