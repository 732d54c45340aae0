#include "hooke/geometry/spatial_order.h"

#include <cstdint>

#include "hooke/geometry/radix_sort.h"

namespace hooke {
namespace {

constexpr size_t block = 4096;
constexpr unsigned bits = 16;  // of each axis

/// Two zeros before each bit.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 16) & 0x0000ff0000ff;
  x = (x | x << 8) & 0x00f00f00f00f;
  x = (x | x << 4) & 0x0c30c30c30c3;
  return (x | x << 2) & 0x249249249249;
}

/// The number of a cell along the curve. J. Skilling, "Programming the Hilbert curve", 2004.
std::uint64_t place_on_curve(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  const auto turn = [&x](std::uint32_t& coordinate, std::uint32_t bit) {
    const bool inverts = coordinate & bit;
    const std::uint32_t exchanged = (x ^ coordinate) & (bit - 1);
    x ^= inverts ? bit - 1 : exchanged;
    coordinate ^= inverts ? 0 : exchanged;
  };
  for (std::uint32_t bit = std::uint32_t{1} << (bits - 1); bit > 1; bit >>= 1) {
    x ^= x & bit ? bit - 1 : 0;
    turn(y, bit);
    turn(z, bit);
  }
  y ^= x;
  z ^= y;
  std::uint32_t flipped = 0;
  for (std::uint32_t bit = std::uint32_t{1} << (bits - 1); bit > 1; bit >>= 1)
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
  parallel_for(points.size(), block, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const Vec3 cell = (points[i] - box.min()) / size * ((std::uint32_t{1} << bits) - 1);
      items[i] = {place_on_curve(static_cast<std::uint32_t>(cell[0]), static_cast<std::uint32_t>(cell[1]),
                                 static_cast<std::uint32_t>(cell[2])),
                  static_cast<int>(i)};
    }
  });
  parallel_radix_sort<Item>(items, buffer, [](const Item& item) { return item.key; });
  std::vector<int> order(points.size());
  parallel_for(points.size(), block, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) order[i] = items[i].id;
  });
  return order;
}

}  // namespace hooke
