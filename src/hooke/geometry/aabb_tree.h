// An axis-aligned bounding box (AABB) tree over triangles, for closest points and pairs of faces whose boxes
// overlap, and the spatial sort that orders its faces.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "hooke/core/lists.h"
#include "hooke/core/parallel.h"
#include "hooke/core/types.h"
#include "hooke/geometry/triangle.h"

namespace hooke {

// Most-significant-digit radix sort, much faster than comparison sorts for millions of items.
// P. M. McIlroy, K. Bostic, M. D. McIlroy, "Engineering radix sort", 1993.

/// Sorts the items by the leading digit of key(item), an unsigned integer, within the range of the keys.
/// Returns the end of each digit's items, or nothing if the items are fully sorted. Stable; the contents of
/// the buffer are overwritten.
template <typename Item, typename Key>
std::vector<size_t> sort_by_first_digit(std::span<Item> items, std::span<Item> buffer, const Key& key) {
  constexpr int max_bits = 9;  // more output positions would exceed the caches
  constexpr size_t few = 16;   // insertion sort is as fast up to this size
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
  std::uint64_t smallest = key(items[0]), largest = smallest;
  for (const Item& item : items) {
    smallest = std::min(smallest, key(item));
    largest = std::max(largest, key(item));
  }
  if (smallest == largest) return {};

  const int bits = std::min(max_bits, static_cast<int>(std::bit_width(n)) - 3);  // a few items per digit
  const int shift = std::max(0, static_cast<int>(std::bit_width(largest - smallest)) - bits);
  const auto digit = [&](const Item& item) { return static_cast<size_t>((key(item) - smallest) >> shift); };
  std::vector<size_t> end((size_t{1} << bits) + 1, 0);
  for (const Item& item : items) ++end[digit(item) + 1];
  for (size_t d = 1; d < end.size(); ++d) end[d] += end[d - 1];
  for (const Item& item : items) buffer[end[digit(item)]++] = item;
  std::ranges::copy(buffer, items.begin());
  end.pop_back();
  return shift == 0 ? std::vector<size_t>{} : end;
}

/// Sorts ascending by key(item), an unsigned integer. Stable. Pre-condition: the buffer is as large as the
/// items.
template <typename Item, typename Key>
void radix_sort(std::span<Item> items, std::span<Item> buffer, const Key& key) {
  size_t begin = 0;
  for (const size_t end : sort_by_first_digit(items, buffer, key)) {
    if (end - begin > 1)
      radix_sort(items.subspan(begin, end - begin), buffer.subspan(begin, end - begin), key);
    begin = end;
  }
}

/// radix_sort() in parallel.
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

// Spatial order: points that are close in space are mostly close in the order.

/// The ids [0, points.size()) in the order of a Hilbert curve through the bounding cube of the points;
/// coincident points ascending. D. Hilbert, "Ueber die stetige Abbildung einer Linie auf ein Flaechenstueck",
/// 1891.
/// Pre-condition: finite coordinates.
std::vector<int> spatial_order(const std::vector<Vec3>& points);

/// Owns a copy of its triangles. Among faces at the same distance the order of faces() decides which one is
/// returned; otherwise results depend on the triangles only. Const calls are thread-safe.
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

  /// Maximum depth. The faces are split in half recursively down to the leaves. Node 1 is the root and the
  /// children of node i are 2 i and 2 i + 1, so that the nodes of a level are consecutive.
  static constexpr int max_depth = 32;

  /// A triangle may repeat a vertex id and then stands for a segment. `order`, if given, becomes the order of
  /// faces(): faces close in it should be close in space. It may leave faces out.
  AabbTree(const Mat3X& points, const std::vector<Triangle>& faces, const std::vector<int>& order = {});

  bool empty() const { return faces_.empty(); }

  /// All faces in the order of a space-filling curve: faces close in it are close in space.
  std::span<const Face> faces() const { return faces_; }

  /// The ids of faces(), in that order.
  std::vector<int> order() const;

  /// The closest point, with the lowest id among the equally close faces visited; face -1 if there is none.
  ClosestPoint closest(const Vec3& x) const {
    return closest(x, [](int) { return true; });
  }

  /// The same among the faces whose ids are accepted; face -1 without any. `known`, the closest point on some
  /// accepted faces of the tree, shortens the search, which otherwise visits every face that is nearer than
  /// the closest accepted one. Of faces that are equally close but for rounding it may make another one the
  /// result.
  template <typename Accepts>
  ClosestPoint closest(const Vec3& x, const Accepts& accepts, const ClosestPoint& known = {}) const;

  /// Is a face no farther away than the distance? Takes less time than closest() where there are many.
  bool has_face_within(double distance, const Vec3& x) const {
    return has_face_within(distance, x, [](int) { return true; });
  }

  /// The same among the faces whose ids are accepted.
  template <typename Accepts>
  bool has_face_within(double distance, const Vec3& x, const Accepts& accepts) const;

  /// The space between two parallel planes.
  struct Slab {
    Vec3 across = Vec3::Zero();  // unit normal of the planes; zero: all of space
    Vec3 centre = Vec3::Zero();
    double half_width = 0;
  };

  /// Of all nodes, as another bound of their faces. Boxes tell little of needles that are slanted to the
  /// axes, as in the fan over a round cap: each overlaps those of most others. Empty where few boxes overlap.
  std::span<const Slab> slabs() const { return slabs_; }

  /// The boxes of all nodes; the leaves are the nodes from leaf_count() on.
  std::span<const Box> boxes() const { return boxes_; }
  size_t leaf_count() const { return boxes_.size() / 2; }
  bool is_leaf(size_t node) const { return node >= leaf_count(); }

  /// Index in faces() of the first face of a leaf, leaves counted from 0. For leaf_count() the number of
  /// faces.
  size_t first_face(size_t leaf) const { return (leaf * faces_.size()) >> depth_; }
  std::span<const Face> faces_of(size_t leaf) const {
    return faces().subspan(first_face(leaf), first_face(leaf + 1) - first_face(leaf));
  }

  /// Calls visit(leaf), in ascending order, for the leaves from `first` on for which is_relevant(node) is
  /// true of their own node and of all those above it.
  template <typename IsRelevant, typename Visit>
  void for_each_leaf(size_t first, const IsRelevant& is_relevant, const Visit& visit) const {
    size_t stack[max_depth + 1];
    int size = 0;
    stack[size++] = 1;
    while (size > 0) {
      const size_t i = stack[--size];
      const int level = static_cast<int>(std::bit_width(i)) - 1;
      const size_t leaves_end = ((i + 1) << (depth_ - level)) - leaf_count();
      if (leaves_end <= first || !is_relevant(i)) continue;
      if (is_leaf(i)) {
        visit(i - leaf_count());
        continue;
      }
      stack[size++] = 2 * i + 1;
      stack[size++] = 2 * i;
    }
  }

  /// Pairs of faces whose boxes overlap are grouped in parts. for_each_overlapping_pair() calls visit(f, g)
  /// for the pairs of the parts [begin, end); each pair belongs to exactly one part.
  size_t parts() const { return (faces_.size() + faces_of_part - 1) / faces_of_part; }
  template <typename Visit>
  void for_each_overlapping_pair(size_t begin, size_t end, const Visit& visit) const {
    for_each_overlapping_pair(
        begin, end, [](std::span<const Face>, std::span<const Face>) { return false; }, visit);
  }

  /// The same but for the pairs of groups that are apart: where many boxes of two small groups overlap, as
  /// those of needles side by side do, are_apart(faces, others) is asked first.
  template <typename AreApart, typename Visit>
  void for_each_overlapping_pair(size_t begin, size_t end, const AreApart& are_apart,
                                 const Visit& visit) const {
    for (size_t part = begin; part < end; ++part) visit_pairs(part * faces_of_part, are_apart, visit);
  }

 private:
  static constexpr size_t leaf_size = 4;
  static constexpr size_t faces_of_part = 16;
  static constexpr int many_pairs = 24;  // of a part and a leaf; 64 are the most

  /// The boxes of a part's faces, coordinate by coordinate.
  struct PartBoxes {
    std::array<std::array<double, faces_of_part>, 3> low, high;
    Box all;

    explicit PartBoxes(std::span<const Face> faces);

    /// Bit mask of the faces whose boxes overlap `other`.
    unsigned overlapping(const Box& other) const;
  };

  /// Visits the pairs of a face of the part that begins at index `first` and a later face.
  template <typename AreApart, typename Visit>
  void visit_pairs(size_t first, const AreApart& are_apart, const Visit& visit) const {
    const std::span<const Face> part = faces().subspan(first, std::min(faces_of_part, faces_.size() - first));
    const PartBoxes boxes(part);
    for_each_leaf(
        (first << depth_) / faces_.size(),
        [&](size_t node) { return boxes_[node].intersects(boxes.all) && !is_beside_slab(node, part); },
        [&](size_t leaf) {
          const size_t begin = std::max(first_face(leaf), first + 1), end = first_face(leaf + 1);
          std::array<unsigned, leaf_size> overlapping{};  // of each face of the leaf
          int count = 0;
          for (size_t index = begin; index < end; ++index) {
            unsigned& bits = overlapping[index - begin];
            bits = boxes.overlapping(faces_[index].box());
            if (index - first < faces_of_part) bits &= (1U << (index - first)) - 1;
            count += std::popcount(bits);
          }
          if (count >= many_pairs && are_apart(part, faces().subspan(begin, end - begin))) return;
          for (size_t index = begin; index < end; ++index)
            for (unsigned bits = overlapping[index - begin]; bits != 0; bits &= bits - 1)
              visit(faces_[first + std::countr_zero(bits)], faces_[index]);
        });
  }

  /// A lower bound of the squared distance of the node's faces.
  double squared_distance_to(size_t node, const Vec3& x) const;

  /// Whether all faces lie on one side of the node's slab.
  bool is_beside_slab(size_t node, std::span<const Face> faces) const;

  void compute_boxes(size_t node, int level);
  bool has_many_overlaps() const;
  void compute_slab(size_t node);

  int depth_ = 0;                    // levels below the root
  UninitializedVector<Face> faces_;  // leaf by leaf
  UninitializedVector<Box> boxes_;   // by node; entry 0 is unused
  std::vector<Slab> slabs_;          // the same, or none
};

/// Keeps the face in `best` if it is closer, or as close and of a lower id.
inline void update_closest(const Vec3& x, const std::array<Vec3, 3>& corners, int id, ClosestPoint& best) {
  const ClosestPoint candidate = closest_point(x, corners[0], corners[1], corners[2]);
  const double d = candidate.squared_distance;
  if (!(d <= best.squared_distance) || (d == best.squared_distance && id >= best.face)) return;
  best = candidate;
  best.face = id;
}

/// 0 within the box. Without branches, which would be mispredicted.
inline double squared_distance(const Vec3& x, const AabbTree::Box& box) {
  return (box.min() - x).cwiseMax(x - box.max()).cwiseMax(0).squaredNorm();
}

/// Bounds the rounding error of a distance to a slab, relative to that to its centre.
inline constexpr double slab_rounding = 1e-14;

inline double AabbTree::squared_distance_to(size_t node, const Vec3& x) const {
  const double to_box = squared_distance(x, boxes_[node]);
  if (slabs_.empty()) return to_box;
  const Slab& slab = slabs_[node];
  const Vec3 d = x - slab.centre;
  const double gap = std::abs(slab.across.dot(d)) - slab.half_width - slab_rounding * d.lpNorm<1>();
  return gap > 0 ? std::max(to_box, gap * gap) : to_box;
}

template <typename Accepts>
bool AabbTree::has_face_within(double distance, const Vec3& x, const Accepts& accepts) const {
  if (empty()) return false;
  const double limit = distance * distance;
  size_t stack[max_depth + 1];
  int size = 0;
  stack[size++] = 1;
  while (size > 0) {
    const size_t node = stack[--size];
    if (squared_distance_to(node, x) > limit) continue;
    if (!is_leaf(node)) {
      const size_t left = 2 * node, right = left + 1;
      const bool left_first = squared_distance_to(left, x) <= squared_distance_to(right, x);
      stack[size++] = left_first ? right : left;
      stack[size++] = left_first ? left : right;
      continue;
    }
    for (const Face& face : faces_of(node - leaf_count()))
      if (squared_distance(x, face.box()) <= limit && accepts(face.id) &&
          closest_point(x, face.corners[0], face.corners[1], face.corners[2]).squared_distance <= limit)
        return true;
  }
  return false;
}

template <typename Accepts>
ClosestPoint AabbTree::closest(const Vec3& x, const Accepts& accepts, const ClosestPoint& known) const {
  ClosestPoint best = known;
  if (empty()) return best;
  struct Visit {
    size_t node;
    double distance;  // squared
  };
  Visit stack[max_depth + 1];
  int size = 0;
  stack[size++] = {1, squared_distance_to(1, x)};
  while (size > 0) {
    const Visit visit = stack[--size];
    if (visit.distance > best.squared_distance) continue;
    if (is_leaf(visit.node)) {
      for (const Face& face : faces_of(visit.node - leaf_count()))
        if (squared_distance(x, face.box()) <= best.squared_distance && accepts(face.id))
          update_closest(x, face.corners, face.id, best);
      continue;
    }
    Visit near{2 * visit.node, squared_distance_to(2 * visit.node, x)};
    Visit far{2 * visit.node + 1, squared_distance_to(2 * visit.node + 1, x)};
    if (far.distance < near.distance) std::swap(near, far);
    if (far.distance <= best.squared_distance) stack[size++] = far;
    if (near.distance <= best.squared_distance) stack[size++] = near;
  }
  return best;
}

}  // namespace hooke
