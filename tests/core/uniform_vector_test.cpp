#include "hooke/core/uniform_vector.h"

#include <gtest/gtest.h>

namespace hooke::uniform_vector_test {

TEST(UniformVector, AreThoseThatWereGivenWhetherTheyVaryOrNot) {
  for (const std::vector<double>& given :
       {std::vector<double>{}, {2}, {2, 2, 2}, {2, 2, 3}, {3, 2, 2}, std::vector<double>(100, .1)}) {
    const UniformVector lengths(given);
    EXPECT_EQ(lengths.size(), given.size());
    EXPECT_EQ(lengths.empty(), given.empty());
    EXPECT_EQ(lengths.values(), given);
    for (size_t i = 0; i < given.size(); ++i) EXPECT_EQ(lengths[i], given[i]);
  }
}

TEST(UniformVector, VaryWhereTwoDiffer) {
  EXPECT_FALSE(UniformVector().is_varying());
  EXPECT_FALSE(UniformVector(std::vector<double>{2}).is_varying());
  EXPECT_FALSE(UniformVector(std::vector<double>{2, 2}).is_varying());
  EXPECT_TRUE(UniformVector(std::vector<double>{2, 2, 2.0000000001}).is_varying());
  EXPECT_EQ(UniformVector(3, 2.), UniformVector(std::vector<double>(3, 2.)));
}

}  // namespace hooke::uniform_vector_test
