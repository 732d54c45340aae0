#include "hooke/fast_log.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hooke {
namespace {

TEST(FastLog, IsTheLogarithm) {
  for (double x = std::numeric_limits<double>::min(); x < 1e300; x *= 1.0137) {
    Lanes logs = {x, 1 / x, 1, 1};
    take_log(logs);
    EXPECT_NEAR(logs[0], std::log(x), 2e-15 * std::abs(std::log(x))) << x;
    EXPECT_NEAR(logs[1], std::log(1 / x), 2e-15 * std::abs(std::log(x))) << x;
  }
}

TEST(FastLog, IsExactAtOneAndAccurateBesideIt) {
  for (double d = 1e-15; d < .5; d *= 3) {
    const double above = 1 + d, below = 1 - d;
    Lanes logs = {above, below, 1, 1};
    take_log(logs);
    EXPECT_EQ(logs[3], 0);
    EXPECT_NEAR(logs[0], std::log(above), 2e-15 * d);
    EXPECT_NEAR(logs[1], std::log(below), 2e-15 * d);
  }
}

}  // namespace
}  // namespace hooke
