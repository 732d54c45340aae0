#include "hooke/core/lists.h"

#include <bit>
#include <cstdint>

namespace hooke {
namespace {

constexpr std::size_t bits = 64;

/// As sort_unique(), by a bit for each number from the least to the greatest; `words` hold these bits.
void sort_by_bits(std::vector<int>& ids, int least, std::size_t words) {
  std::vector<std::uint64_t> is_among(words, 0);
  for (int id : ids) {
    const std::size_t at = id - least;
    is_among[at / bits] |= std::uint64_t{1} << (at % bits);
  }
  ids.clear();
  for (std::size_t w = 0; w < words; ++w)
    for (std::uint64_t rest = is_among[w]; rest != 0; rest &= rest - 1)
      ids.push_back(least + static_cast<int>(bits * w) + std::countr_zero(rest));
}

}  // namespace

void sort_unique(std::vector<int>& ids) {
  if (ids.empty()) return;
  const auto [least, greatest] = std::ranges::minmax(ids);
  const std::size_t words = (greatest - least) / bits + 1;
  if (words <= ids.size()) return sort_by_bits(ids, least, words);
  std::ranges::sort(ids);
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

std::vector<int> sorted_union(const IntLists& lists, const std::vector<int>& indices) {
  std::vector<int> all;
  for (int i : indices) all.insert(all.end(), lists[i].begin(), lists[i].end());
  sort_unique(all);
  return all;
}

}  // namespace hooke
