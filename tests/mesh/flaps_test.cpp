#include "hooke/mesh/flaps.h"

#include <gtest/gtest.h>

namespace hooke::flaps_test {

TEST(Flaps, AFinOfTwoPairsOnABodyIsOne) {
  const std::vector<Triangle> t{{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {4, 1, 0}, {1, 5, 4}, {4, 5, 1}};
  EXPECT_EQ(find_flaps(t, {{2, 3}, {4, 5}}), (std::vector<int>{2, 3, 4, 5}));
  EXPECT_EQ(find_flaps(t, {{4, 5}}), std::vector<int>{}) << "it would leave a pair, which is a sheet";
  EXPECT_EQ(find_flaps(t, {}), std::vector<int>{});
}

TEST(Flaps, AWallWithinABodyIsOne) {
  const std::vector<Triangle> t{{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {1, 0, 4},
                                {2, 1, 4}, {0, 2, 4}, {0, 2, 1}, {1, 2, 0}};
  EXPECT_EQ(find_flaps(t, {{6, 7}}), (std::vector<int>{6, 7}));
}

TEST(Flaps, WhatWouldLeaveAnOpeningIsNone) {
  const std::vector<Triangle> t{{0, 1, 2}, {0, 1, 3}, {1, 0, 3}};  // only one other face at the edge 0 1
  EXPECT_EQ(find_flaps(t, {{1, 2}}), std::vector<int>{});
  const std::vector<Triangle> chain{{0, 1, 2}, {0, 1, 3}, {1, 0, 3}, {1, 4, 3}, {3, 4, 1}};
  EXPECT_EQ(find_flaps(chain, {{1, 2}, {3, 4}}), std::vector<int>{});
}

TEST(Flaps, ASheetWithTwoSidesIsNone) {
  const std::vector<Triangle> t{{0, 1, 2}, {2, 1, 0}, {1, 3, 2}, {2, 3, 1}};
  EXPECT_EQ(find_flaps(t, {{0, 1}, {2, 3}}), std::vector<int>{});
}

}  // namespace hooke::flaps_test
