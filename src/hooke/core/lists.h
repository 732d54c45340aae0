// Lists of ints in one array.
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
  std::vector<int> first;  // size n + 1
  std::vector<int> items;

  std::span<const int> operator[](int i) const {
    return {items.data() + first[static_cast<size_t>(i)], items.data() + first[static_cast<size_t>(i) + 1]};
  }
};

/// What the lists of these indices hold, each once, ascending.
inline std::vector<int> sorted_union(const IntLists& lists, const std::vector<int>& indices) {
  std::vector<int> all;
  for (int i : indices) all.insert(all.end(), lists[i].begin(), lists[i].end());
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// For each index in [0, count) the places of the rows that name it, ascending. A row is a range of indices.
/// Each thread looks through all rows for the indices of its share: what it writes stays in its caches.
template <typename Rows>
IntLists inverse(int count, const Rows& rows) {
  constexpr int min_share = 1 << 14;
  const int shares = std::clamp(count / min_share, 1, thread_count());
  const auto for_each_share = [&](const auto& use) {  // use(row, index) for the indices of one share
    parallel_for(static_cast<size_t>(shares), 1, [&](size_t first, size_t last) {
      const auto bound = [&](size_t share) {
        return static_cast<int>(static_cast<size_t>(count) * share / static_cast<size_t>(shares));
      };
      const int begin = bound(first), end = bound(last);
      for (size_t r = 0; r < rows.size(); ++r)
        for (int i : rows[r])
          if (i >= begin && i < end) use(static_cast<int>(r), static_cast<size_t>(i));
    });
  };
  IntLists lists;
  lists.first.assign(static_cast<size_t>(count) + 1, 0);
  for_each_share([&](int, size_t i) { ++lists.first[i + 1]; });
  std::partial_sum(lists.first.begin(), lists.first.end(), lists.first.begin());
  lists.items.resize(static_cast<size_t>(lists.first.back()));
  std::vector<int> next(lists.first.begin(), lists.first.end() - 1);
  for_each_share([&](int r, size_t i) { lists.items[static_cast<size_t>(next[i]++)] = r; });
  return lists;
}

// Large arrays whose items are written by all cores. An ordinary vector fills them beforehand, on one core,
// and that costs more than what is written then: memory is handed out as it is first touched.

template <typename T>
struct UnfilledAllocator : std::allocator<T> {
  template <typename U>
  struct rebind {
    using other = UnfilledAllocator<U>;
  };
  template <typename U>
  void construct(U*) noexcept {}
  template <typename U, typename... Args>
  void construct(U* place, Args&&... args) {
    std::construct_at(place, std::forward<Args>(args)...);
  }
};

/// Items that are given no value have none: each must be written before it is read. For plain values, which
/// need neither be built nor destroyed.
template <typename T>
using UnfilledVector = std::vector<T, UnfilledAllocator<T>>;

// A list of the few ids about a vertex.

/// As many as most vertices have take no memory of their own.
using ShortList = boost::container::small_vector<int, 12>;

}  // namespace hooke
