// Axis-parallel boxes around triangles, as a binary tree: closest points and candidates for intersections.
#pragma once

#include <span>

#include "hooke/types.h"

namespace hooke {

struct ClosestPoint {
  Vec3 point = Vec3::Zero();
  double squared_distance = 0;
  int face = -1;  // the lowest id among equals that were visited; -1 when the tree is empty
};

/// Closest point of one triangle. Exact in the cases: a triangle without area is taken as its edges.
ClosestPoint closest_point(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c);

/// Weights of the corners at a point of the triangle, not negative, with sum 1.
Vec3 barycentric(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c);

/// Owns a copy of its triangles. Answers depend on nothing but the triangles and the question; const calls
/// are safe from several threads.
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

  static constexpr int max_depth = 64;  // halving 2^31 faces needs 31
  struct Node {
    Box box;
    int first_or_right = 0;  // leaf: place in faces(); else: right child, the left one follows its parent
    int count = 0;           // faces of a leaf; 0 for an inner node
  };

  /// A triangle may repeat a vertex id: it then stands for a segment.
  BoundingVolumeTree(const Mat3X& points, const std::vector<Triangle>& faces);

  bool empty() const { return faces_.empty(); }

  /// All faces; those that stand close here are close in space.
  std::span<const Face> faces() const { return faces_; }

  /// `hint` is a face that is likely close (-1: none): it saves time.
  ClosestPoint closest(const Vec3& x, int hint = -1) const;

  /// The same for many points with a hint each, fast where points that stand next to each other are close in
  /// space. Of faces at the same distance up to rounding any may be told.
  void closest(std::span<const Vec3> points, std::span<const int> hints,
               std::span<ClosestPoint> results) const;

  /// The pairs of faces whose boxes meet come in parts, one per node: with parts [begin, end) visit(f, g) is
  /// called for theirs. All parts together have each pair once.
  size_t parts() const { return nodes_.size(); }
  template <typename Visit>
  void for_each_meeting_pair(size_t begin, size_t end, const Visit& visit) const {
    for (size_t part = begin; part < end; ++part) {
      const auto mine = faces_of(part);
      if (mine.empty()) continue;
      for_each_leaf_meeting(nodes_[part].box, part, [&](size_t leaf) {
        const auto others = faces_of(leaf);
        for (size_t i = 0; i < mine.size(); ++i) {
          const Box box = mine[i].box();
          for (size_t k = leaf == part ? i + 1 : 0; k < others.size(); ++k)
            if (others[k].box().intersects(box)) visit(mine[i], others[k]);
        }
      });
    }
  }

 private:
  static constexpr size_t leaf_size = 4;

  struct Centre {
    Vec3 point;
    int face;
  };
  struct Range {  // of centres that become the node and all below it
    size_t begin, end, node;
  };

  /// Calls visit(node) for the leaves from node `first` on whose boxes meet `box`.
  template <typename Visit>
  void for_each_leaf_meeting(const Box& box, size_t first, const Visit& visit) const {
    if (empty()) return;
    int stack[max_depth];
    int size = 0;
    stack[size++] = 0;
    while (size > 0) {
      const int i = stack[--size];
      const Node& node = nodes_[static_cast<size_t>(i)];
      if (!node.box.intersects(box)) continue;
      if (node.count > 0) {
        if (static_cast<size_t>(i) >= first) visit(static_cast<size_t>(i));
        continue;
      }
      stack[size++] = node.first_or_right;
      if (static_cast<size_t>(node.first_or_right) > first) stack[size++] = i + 1;
    }
  }

  /// Empty for an inner node.
  std::span<const Face> faces_of(size_t node) const {
    return {faces_.data() + (nodes_[node].count > 0 ? nodes_[node].first_or_right : 0),
            static_cast<size_t>(nodes_[node].count)};
  }

  bool divide(const Range& range, std::vector<Centre>& centres, Range& left, Range& right);
  void build(const Range& range, std::vector<Centre>& centres);
  void build_all(std::vector<Centre>& centres);
  void enclose_nodes();
  const Face& face(int id) const { return faces_[static_cast<size_t>(place_[static_cast<size_t>(id)])]; }

  std::vector<Face> faces_;  // leaf by leaf
  std::vector<int> place_;   // in faces_, by face id
  std::vector<Node> nodes_;
};

}  // namespace hooke
