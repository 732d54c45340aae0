#include "hooke/core/simd.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace hooke::simd_test {

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

TEST(FastAngle, IsTheAngle) {
  for (double angle = 1e-9; angle < 1.57; angle = 1.07 * angle + 1e-9) {
    const Lanes x = {std::cos(angle), 3 * std::cos(angle), 0, 1},
                y = {std::sin(angle), 3 * std::sin(angle), 1, 1};
    const Lanes r = {1, 3, 1, std::sqrt(2.)};
    Lanes found;
    take_angle(x, y, r, found);
    EXPECT_NEAR(found[0], angle, 4e-15 * angle);
    EXPECT_NEAR(found[1], angle, 4e-15 * angle);
    EXPECT_NEAR(found[2], std::numbers::pi / 2, 4e-15);
    EXPECT_NEAR(found[3], std::numbers::pi / 4, 4e-15);
  }
}

}  // namespace hooke::simd_test
