#include "hooke/geometry/aabb_tree.h"

#include <gtest/gtest.h>

#include <random>

namespace hooke {
namespace {

struct Item {
  std::uint64_t key;
  int id;
};

/// Keys of up to so many bits, some of them alike.
std::vector<Item> random_items(size_t count, int bits) {
  std::mt19937_64 random(count);
  std::vector<Item> items;
  for (size_t i = 0; i < count; ++i)
    items.push_back({i % 3 == 0 && i > 0 ? items[i / 2].key : random() >> (64 - bits), static_cast<int>(i)});
  return items;
}

TEST(RadixSort, IsAStableSort) {
  for (size_t count : {0, 1, 2, 16, 17, 100, 5000, 100000})
    for (int bits : {1, 5, 40, 64}) {
      std::vector<Item> items = random_items(count, bits), expected = items, parallel = items;
      std::vector<Item> buffer(count);
      const auto key = [](const Item& item) { return item.key; };
      std::ranges::stable_sort(expected, {}, &Item::key);
      radix_sort<Item>(items, buffer, key);
      parallel_radix_sort<Item>(parallel, buffer, key);
      for (size_t i = 0; i < count; ++i) {
        ASSERT_EQ(items[i].id, expected[i].id);
        ASSERT_EQ(parallel[i].id, expected[i].id);
      }
    }
}

}  // namespace
}  // namespace hooke
