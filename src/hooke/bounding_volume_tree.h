// Axis-parallel boxes around triangles, as a binary tree: closest points and candidates for intersections.
#pragma once

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

  /// A triangle may repeat a vertex id: it then stands for a segment.
  BoundingVolumeTree(const Mat3X& points, const std::vector<Triangle>& faces);

  bool empty() const { return faces_.empty(); }

  /// `hint` is a face that is likely close (-1: none): it saves time.
  ClosestPoint closest(const Vec3& x, int hint = -1) const;

  /// Calls visit(f) for each face whose box meets `box`, in the order of the tree.
  template <typename Visit>
  void for_each_meeting(const Box& box, const Visit& visit) const {
    if (empty()) return;
    int stack[max_depth];
    int size = 0;
    stack[size++] = 0;
    while (size > 0) {
      const int i = stack[--size];
      const Node& node = nodes_[static_cast<size_t>(i)];
      if (!node.box.intersects(box)) continue;
      if (node.count == 0) {
        stack[size++] = node.first_or_right;
        stack[size++] = i + 1;
        continue;
      }
      const Face* face = faces_.data() + node.first_or_right;
      for (int k = 0; k < node.count; ++k)
        if (face[k].box.intersects(box)) visit(face[k].id);
    }
  }

 private:
  static constexpr int max_depth = 64;  // halving 2^31 faces needs 31
  static constexpr int leaf_size = 4;

  struct Face {
    Box box;
    std::array<Vec3, 3> corners;
    int id;
  };
  struct Node {
    Box box;
    int first_or_right = 0;  // leaf: place in faces_; else: right child, the left one follows its parent
    int count = 0;           // faces of a leaf; 0 for an inner node
  };
  struct Centre {
    Vec3 point;
    int face;
  };

  void build(size_t begin, size_t end, std::vector<Centre>& centres, const std::vector<Box>& boxes);
  static void try_face(const Vec3& x, const Face& face, ClosestPoint& best);

  std::vector<Face> faces_;  // leaf by leaf
  std::vector<int> place_;   // in faces_, by face id
  std::vector<Node> nodes_;
};

}  // namespace hooke
