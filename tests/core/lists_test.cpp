#include "hooke/core/lists.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>

#include "hooke/core/types.h"

namespace hooke::lists_test {

TEST(IntLists, AreInvertedAlikeByAnyNumberOfThreads) {
  constexpr int count = 100000;  // enough for several threads
  std::mt19937 random(1);
  std::uniform_int_distribution<int> id(0, count - 1);
  std::vector<Triangle> rows(2 * count);
  for (Triangle& row : rows) row = {id(random), id(random), id(random)};
  std::vector<std::vector<int>> expected(count);
  for (size_t r = 0; r < rows.size(); ++r)
    for (int i : rows[r]) expected[i].push_back(static_cast<int>(r));
  for (int threads : {1, 0}) {
    const ThreadLimit limit(threads);
    const IntLists lists = inverse(count, rows);
    for (int i = 0; i < count; ++i) ASSERT_TRUE(std::ranges::equal(lists[i], expected[i])) << i;
  }
}

TEST(IntLists, IndicesThatNoRowNamesHaveEmptyLists) {
  const IntLists lists = inverse(3, std::vector<Edge>{{2, 0}, {0, 2}});
  EXPECT_EQ(lists.first, (std::vector<int>{0, 2, 2, 4}));
  EXPECT_EQ(lists.items, (std::vector<int>{0, 1, 0, 1}));
  EXPECT_EQ(inverse(0, std::vector<Edge>()).first, std::vector<int>{0});
}

TEST(SortUnique, IsThatOfASetHoweverFarApartTheNumbersAre) {
  std::mt19937 random(2);
  for (const int greatest : {0, 1, 63, 64, 65, 1000, 1 << 20, std::numeric_limits<int>::max()})
    for (const int count : {0, 1, 2, 50, 3000}) {
      std::uniform_int_distribution<int> number(greatest / 3, greatest);
      std::vector<int> ids;
      for (int i = 0; i < count; ++i) ids.push_back(number(random));
      if (count > 1) ids[0] = ids.back() = greatest;
      const std::set<int> expected(ids.begin(), ids.end());
      sort_unique(ids);
      EXPECT_TRUE(std::ranges::equal(ids, expected)) << greatest << " " << count;
    }
}

TEST(SortedUnion, IsThatOfTheListsNamed) {
  const IntLists lists{{0, 3, 3, 5}, {7, 2, 900, 2, 1}};
  EXPECT_EQ(sorted_union(lists, {2, 0}), (std::vector<int>{1, 2, 7, 900}));
  EXPECT_TRUE(sorted_union(lists, {1}).empty());
  EXPECT_TRUE(sorted_union(lists, {}).empty());
}

}  // namespace hooke::lists_test
