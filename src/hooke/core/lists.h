// Containers for many integers: lists of ints stored in one array, vectors whose elements stay uninitialized,
// and short lists without heap memory.
#pragma once

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <memory>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "hooke/core/parallel.h"

namespace hooke {

/// Lists of ints, one per index, stored end to end.
struct IntLists {
  std::vector<int> first;  // start of each list in `items`; size n + 1
  std::vector<int> items;  // all lists, end to end

  std::span<const int> operator[](int i) const {
    return {items.data() + first[i], items.data() + first[i + 1]};
  }
};

/// The sorted union of the lists with these indices, without duplicates.
std::vector<int> sorted_union(const IntLists& lists, const std::vector<int>& indices);

/// Sorts the numbers, none of which is negative, and removes repeats. Linear where they are close together.
void sort_unique(std::vector<int>& ids);

/// The inverse of an incidence: for each index in [0, count), the ids of the rows that contain it, ascending.
/// A row is a range of indices. Each thread scans all rows for the indices of its share, so that what it
/// writes stays in its caches.
template <typename Rows>
IntLists inverse(int count, const Rows& rows) {
  constexpr int min_share = 1 << 14;
  const int shares = std::clamp(count / min_share, 1, thread_count());
  const auto for_each_share = [&](const auto& use) {  // calls use(row, index) for the indices of each share
    parallel_for(shares, 1, [&](size_t first, size_t last) {
      const auto bound = [&](size_t share) {
        return static_cast<int>(static_cast<size_t>(count) * share / static_cast<size_t>(shares));
      };
      const int begin = bound(first), end = bound(last);
      for (size_t r = 0; r < rows.size(); ++r)
        for (int i : rows[r])
          if (i >= begin && i < end) use(static_cast<int>(r), i);
    });
  };
  IntLists lists;
  lists.first.assign(static_cast<size_t>(count) + 1, 0);
  for_each_share([&](int, size_t i) { ++lists.first[i + 1]; });
  std::partial_sum(lists.first.begin(), lists.first.end(), lists.first.begin());
  lists.items.resize(lists.first.back());
  std::vector<int> next(lists.first.begin(), lists.first.end() - 1);
  for_each_share([&](int r, size_t i) { lists.items[next[i]++] = r; });
  return lists;
}

// Uninitialized vectors. An ordinary vector zeroes a large array on one thread, which costs more than filling
// it in parallel later, because the system provides memory pages when they are first touched.

template <typename T>
struct UninitializedAllocator : std::allocator<T> {
  template <typename U>
  struct rebind {
    using other = UninitializedAllocator<U>;
  };
  template <typename U>
  void construct(U*) noexcept {}
  template <typename U, typename... Args>
  void construct(U* pointer, Args&&... args) {
    std::construct_at(pointer, std::forward<Args>(args)...);
  }
};

/// A vector whose new elements are uninitialized unless a value is given: each must be written before it is
/// read. For types with trivial constructor and destructor.
template <typename T>
using UninitializedVector = std::vector<T, UninitializedAllocator<T>>;

/// The ids of the neighbours of a vertex. Up to 12, enough for most vertices, need no heap memory.
using SmallIntList = boost::container::small_vector<int, 12>;

}  // namespace hooke
