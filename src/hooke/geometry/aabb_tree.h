// Sorting by the digits of a number, the highest first: for the millions of a large mesh much faster than
// comparing. P. M. McIlroy, K. Bostic, M. D. McIlroy, "Engineering radix sort", 1993.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "hooke/core/lists.h"
#include "hooke/core/parallel.h"
#include "hooke/core/types.h"

namespace hooke {

/// Sorts by one digit of key(item), an unsigned number, of the range in which the keys are, and returns where
/// the items of each digit end; nothing when all are in order. Items of a digit keep their order. What the
/// buffer holds is lost.
template <typename Item, typename Key>
std::vector<size_t> sort_by_first_digit(std::span<Item> items, std::span<Item> buffer, const Key& key) {
  constexpr int max_bits = 9;  // more places to write to are too many for the caches
  constexpr size_t few = 16;   // as quick by insertion
  const size_t n = items.size();
  if (n <= few) {
    for (size_t i = 1; i < n; ++i) {
      const Item item = items[i];
      size_t k = i;
      for (; k > 0 && key(item) < key(items[k - 1]); --k) items[k] = items[k - 1];
      items[k] = item;
    }
    return {};
  }
  std::uint64_t least = key(items[0]), greatest = least;
  for (const Item& item : items) {
    least = std::min(least, key(item));
    greatest = std::max(greatest, key(item));
  }
  if (least == greatest) return {};

  const int bits = std::min(max_bits, static_cast<int>(std::bit_width(n)) - 3);  // a handful to each digit
  const int shift = std::max(0, static_cast<int>(std::bit_width(greatest - least)) - bits);
  const auto digit = [&](const Item& item) { return static_cast<size_t>((key(item) - least) >> shift); };
  std::vector<size_t> end((size_t{1} << bits) + 1, 0);
  for (const Item& item : items) ++end[digit(item) + 1];
  for (size_t d = 1; d < end.size(); ++d) end[d] += end[d - 1];
  for (const Item& item : items) buffer[end[digit(item)]++] = item;
  std::ranges::copy(buffer, items.begin());
  end.pop_back();
  return shift == 0 ? std::vector<size_t>{} : end;
}

/// Ascending by key(item), an unsigned number; items with equal keys keep their order. The buffer is as large
/// as the items.
template <typename Item, typename Key>
void radix_sort(std::span<Item> items, std::span<Item> buffer, const Key& key) {
  size_t begin = 0;
  for (const size_t end : sort_by_first_digit(items, buffer, key)) {
    if (end - begin > 1)
      radix_sort(items.subspan(begin, end - begin), buffer.subspan(begin, end - begin), key);
    begin = end;
  }
}

/// The same in parallel.
template <typename Item, typename Key>
void parallel_radix_sort(std::span<Item> items, std::span<Item> buffer, const Key& key) {
  const std::vector<size_t> ends = sort_by_first_digit(items, buffer, key);
  parallel_for(ends.size(), 1, [&](size_t first, size_t last) {
    for (size_t d = first; d < last; ++d) {
      const size_t begin = d == 0 ? 0 : ends[d - 1];
      radix_sort(items.subspan(begin, ends[d] - begin), buffer.subspan(begin, ends[d] - begin), key);
    }
  });
}

// An order in which what is close in space mostly stands close.

/// The ids [0, points.size()) along a Hilbert curve through the cube about the points; ascending where they
/// coincide. D. Hilbert, "Ueber die stetige Abbildung einer Linie auf ein Flaechenstueck", 1891.
/// Pre-condition: finite.
std::vector<int> spatial_order(const std::vector<Vec3>& points);

// Axis-parallel boxes around triangles, as a binary tree: closest points and candidates for intersections.

struct ClosestPoint {
  Vec3 point = Vec3::Zero();
  double squared_distance = 0;
  int face = -1;  // the lowest id among equals that were visited; -1 when the tree is empty
};

/// Thinner triangles have no normal to speak of: their edges are as close as their inside. Doubled, over the
/// fourth power of the longest edge.
inline constexpr double min_triangle_squared_area = 1e-24;

/// Closest point of one triangle. Exact in the cases: a triangle without area is taken as its edges.
ClosestPoint closest_point(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c);

/// Weights of the corners at a point of the triangle, not negative, with sum 1.
Vec3 barycentric(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c);

/// Owns a copy of its triangles. Of faces at the same distance the order of faces() decides which one
/// is told; else answers depend on nothing but the triangles. Const calls are safe from several threads.
class AabbTree {
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
  AabbTree(const Mat3X& points, const std::vector<Triangle>& faces, const std::vector<int>& order = {});

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
