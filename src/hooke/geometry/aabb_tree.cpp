#include "hooke/geometry/aabb_tree.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "hooke/core/parallel.h"
#include "hooke/core/simd.h"

namespace hooke {
namespace {

constexpr size_t sort_block = 4096;
constexpr unsigned bits_per_axis = 16;  // per axis

/// Inserts two zero bits_per_axis before each bit.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 16) & 0x0000ff0000ff;
  x = (x | x << 8) & 0x00f00f00f00f;
  x = (x | x << 4) & 0x0c30c30c30c3;
  return (x | x << 2) & 0x249249249249;
}

/// Index of a grid cell along the Hilbert curve. J. Skilling, "Programming the Hilbert curve", 2004.
std::uint64_t hilbert_index(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  const auto turn = [&x](std::uint32_t& coordinate, std::uint32_t bit) {
    const bool inverts = coordinate & bit;
    const std::uint32_t exchanged = (x ^ coordinate) & (bit - 1);
    x ^= inverts ? bit - 1 : exchanged;
    coordinate ^= inverts ? 0 : exchanged;
  };
  for (std::uint32_t bit = std::uint32_t{1} << (bits_per_axis - 1); bit > 1; bit >>= 1) {
    x ^= x & bit ? bit - 1 : 0;
    turn(y, bit);
    turn(z, bit);
  }
  y ^= x;
  z ^= y;
  std::uint32_t flipped = 0;
  for (std::uint32_t bit = std::uint32_t{1} << (bits_per_axis - 1); bit > 1; bit >>= 1)
    flipped ^= z & bit ? bit - 1 : 0;
  return spread(x ^ flipped) << 2 | spread(y ^ flipped) << 1 | spread(z ^ flipped);
}

}  // namespace

std::vector<int> spatial_order(const std::vector<Vec3>& points) {
  struct Item {
    std::uint64_t key;
    int id;
  };
  Eigen::AlignedBox3d box;
  for (const Vec3& p : points) box.extend(p);
  const double longest = points.empty() ? 0 : box.sizes().maxCoeff();
  const double size = longest > 0 ? longest : 1;
  std::vector<Item> items(points.size()), buffer(points.size());
  parallel_for(points.size(), sort_block, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const Vec3 cell = (points[i] - box.min()) / size * ((std::uint32_t{1} << bits_per_axis) - 1);
      items[i] = {hilbert_index(static_cast<std::uint32_t>(cell[0]), static_cast<std::uint32_t>(cell[1]),
                                static_cast<std::uint32_t>(cell[2])),
                  static_cast<int>(i)};
    }
  });
  parallel_radix_sort<Item>(items, buffer, [](const Item& item) { return item.key; });
  std::vector<int> order(points.size());
  parallel_for(points.size(), sort_block, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) order[i] = items[i].id;
  });
  return order;
}

namespace {

constexpr size_t tree_block = 1024;

AabbTree::Face face_of(const Mat3X& points, const std::vector<Triangle>& faces, size_t id) {
  const auto& [a, b, c] = faces[id];
  return {{points.col(a), points.col(b), points.col(c)}, {a, b, c}, static_cast<int>(id)};
}

std::vector<Vec3> centres(const Mat3X& points, const std::vector<Triangle>& faces) {
  std::vector<Vec3> centres(faces.size());
  parallel_for(faces.size(), tree_block, [&](size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) centres[f] = face_of(points, faces, f).box().center();
  });
  return centres;
}

}  // namespace

AabbTree::AabbTree(const Mat3X& points, const std::vector<Triangle>& faces,
                   const std::vector<int>& given_order) {
  const std::vector<int> own_order =
      given_order.empty() ? spatial_order(centres(points, faces)) : std::vector<int>();
  const std::vector<int>& order = given_order.empty() ? own_order : given_order;
  faces_.resize(order.size());
  parallel_for(order.size(), tree_block, [&](size_t begin, size_t end) {
    for (size_t k = begin; k < end; ++k) faces_[k] = face_of(points, faces, order[k]);
  });
  while (order.size() > leaf_size << depth_) ++depth_;
  boxes_.resize(size_t{2} << depth_);
  boxes_[0] = Box();
  compute_boxes(1, 0);
  if (!has_many_overlaps()) return;
  slabs_.resize(boxes_.size());
  parallel_for(slabs_.size(), tree_block, [&](size_t begin, size_t end) {
    for (size_t node = std::max<size_t>(begin, 1); node < end; ++node) compute_slab(node);
  });
}

std::vector<int> AabbTree::order() const {
  std::vector<int> ids(faces_.size());
  std::ranges::transform(faces_, ids.begin(), &Face::id);
  return ids;
}

/// Computes the boxes of a subtree; the subtrees of the upper levels run in parallel.
void AabbTree::compute_boxes(size_t node, int level) {
  constexpr int upper_levels = 7;
  if (is_leaf(node)) {
    Box box;
    for (const Face& face : faces_of(node - leaf_count())) box.extend(face.box());
    boxes_[node] = box;
    return;
  }
  const auto compute_children = [&](size_t begin, size_t end) {
    for (size_t child = begin; child < end; ++child) compute_boxes(2 * node + child, level + 1);
  };
  if (level < upper_levels)
    parallel_for(2, 1, compute_children);
  else
    compute_children(0, 2);
  boxes_[node] = boxes_[2 * node].merged(boxes_[2 * node + 1]);
}

/// Whether many boxes of other faces hold the middle of a face, on average over some faces.
bool AabbTree::has_many_overlaps() const {
  constexpr size_t sample = 64, many = 24;
  if (faces_.size() < sample) return false;
  size_t overlaps = 0;
  for (size_t k = 0; k < sample; ++k) {
    const auto& [a, b, c] = faces_[k * faces_.size() / sample].corners;
    const Vec3 middle = (a + b + c) / 3;
    for_each_leaf(
        0, [&](size_t node) { return boxes_[node].contains(middle); },
        [&](size_t leaf) {
          for (const Face& face : faces_of(leaf)) overlaps += face.box().contains(middle);
        });
  }
  return overlaps > many * sample;
}

/// The planes are perpendicular to the direction in which the corners spread second most: the most is along
/// the needles, the least across the surface.
void AabbTree::compute_slab(size_t node) {
  constexpr size_t max_faces = 1024;  // wider sectors have no such direction
  const int levels_below = depth_ + 1 - static_cast<int>(std::bit_width(node));
  const size_t first = first_face((node << levels_below) - leaf_count()),
               end = first_face(((node + 1) << levels_below) - leaf_count());
  if (first == end || end - first > max_faces) return;
  const std::span<const Face> some = faces().subspan(first, end - first);
  Slab slab{.centre = boxes_[node].center()};
  const auto for_each_corner = [&](const auto& visit) {
    for (const Face& face : some)
      for (const Vec3& corner : face.corners) visit(Vec3(corner - slab.centre));
  };
  Vec3 mean = Vec3::Zero();
  for_each_corner([&](const Vec3& d) { mean += d / (3. * static_cast<double>(some.size())); });
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for_each_corner([&](const Vec3& d) { spread += (d - mean) * (d - mean).transpose(); });
  const Vec3 across = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(1);
  if (!(std::abs(across.squaredNorm() - 1) < slab_rounding)) return;  // overflow
  double low = std::numeric_limits<double>::infinity(), high = -low, size = 0;
  for_each_corner([&](const Vec3& d) {
    low = std::min(low, across.dot(d));
    high = std::max(high, across.dot(d));
    size = std::max(size, d.lpNorm<1>());
  });
  slab.across = across;
  slab.centre += .5 * (low + high) * across;
  slab.half_width = .5 * (high - low) + slab_rounding * (size + slab.centre.lpNorm<1>());
  slabs_[node] = slab;
}

bool AabbTree::is_beside_slab(size_t node, std::span<const Face> faces) const {
  if (slabs_.empty()) return false;
  const Slab& slab = slabs_[node];
  bool below = true, above = true;
  for (const Face& face : faces)
    for (const Vec3& corner : face.corners) {
      const Vec3 d = corner - slab.centre;
      const double height = slab.across.dot(d), limit = slab.half_width + slab_rounding * d.lpNorm<1>();
      below = below && height < -limit;
      above = above && height > limit;
      if (!below && !above) return false;
    }
  return true;
}

AabbTree::PartBoxes::PartBoxes(std::span<const Face> faces) {
  const Box nowhere;
  for (size_t i = 0; i < faces_of_part; ++i) {
    const Box box = i < faces.size() ? faces[i].box() : nowhere;
    all.extend(box);
    for (size_t d = 0; d < 3; ++d) {
      low[d][i] = box.min()[static_cast<Eigen::Index>(d)];
      high[d][i] = box.max()[static_cast<Eigen::Index>(d)];
    }
  }
}

HOOKE_SIMD unsigned AabbTree::PartBoxes::overlapping(const Box& other) const {
  constexpr LaneMask bits = {1, 2, 4, 8};
  LaneMask found = {};
  for (size_t k = 0; k < faces_of_part; k += lane_count) {
    LaneMask overlap = bits << static_cast<int>(k);
    for (size_t d = 0; d < 3; ++d) {
      const auto axis = static_cast<Eigen::Index>(d);
      Lanes lows, highs;
      load(&low[d][k], lows);
      load(&high[d][k], highs);
      overlap &= (lows <= other.max()[axis]) & (highs >= other.min()[axis]);
    }
    found |= overlap;
  }
  return static_cast<unsigned>(found[0] | found[1] | found[2] | found[3]);
}

}  // namespace hooke
