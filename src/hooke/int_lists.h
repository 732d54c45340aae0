// Lists of ints in one array.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

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
inline std::vector<int> united(const IntLists& lists, const std::vector<int>& indices) {
  std::vector<int> all;
  for (int i : indices) all.insert(all.end(), lists[i].begin(), lists[i].end());
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// For each index in [0, count) the places of the rows that name it, ascending. A row is a range of indices.
template <typename Rows>
IntLists invert(int count, const Rows& rows) {
  IntLists lists;
  lists.first.assign(static_cast<size_t>(count) + 1, 0);
  for (const auto& row : rows)
    for (int i : row) ++lists.first[static_cast<size_t>(i) + 1];
  for (size_t i = 0; i < static_cast<size_t>(count); ++i) lists.first[i + 1] += lists.first[i];
  lists.items.resize(static_cast<size_t>(lists.first.back()));
  std::vector<int> next(lists.first.begin(), lists.first.end() - 1);
  for (size_t r = 0; r < rows.size(); ++r)
    for (int i : rows[r])
      lists.items[static_cast<size_t>(next[static_cast<size_t>(i)]++)] = static_cast<int>(r);
  return lists;
}

}  // namespace hooke
