// Sorting by the digits of a number, the highest first: for the millions of a large mesh much faster than
// comparing. P. M. McIlroy, K. Bostic, M. D. McIlroy, "Engineering radix sort", 1993.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "hooke/core/parallel.h"

namespace hooke {

/// Sorts by one digit of key(item), an unsigned number, of the range in which the keys are, and returns where
/// the items of each digit end; nothing when all are in order. Items of a digit keep their order. What the
/// buffer holds is lost.
template <typename Item, typename Key>
std::vector<size_t> sort_by_first_digit(std::span<Item> items, std::span<Item> buffer, const Key& key) {
  constexpr int most_bits = 9;  // more places to write to are too many for the caches
  constexpr size_t few = 16;    // as quick by insertion
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

  const int bits = std::min(most_bits, static_cast<int>(std::bit_width(n)) - 3);  // a handful to each digit
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

}  // namespace hooke
