#include "hooke/integrator/relaxation.h"

#include <gtest/gtest.h>

#include <set>

#include "support/scene.h"

namespace hooke::relaxation_test {

IntegrationOptions rest(double drop, int window) {
  IntegrationOptions options;
  options.energy_drop = drop;
  options.window = window;
  return options;
}

TEST(RestDetector, IsNotAtRestBeforeTheWindowIsFull) {
  RestDetector detector(rest(1e-3, 3));
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(detector.at_rest(1));
  EXPECT_TRUE(detector.at_rest(1));
}

TEST(RestDetector, MeasuresTheDropOverTheWindow) {
  RestDetector fast(rest(1e-3, 2)), slow(rest(1e-3, 2));
  double energy = 1;
  for (int i = 0; i < 20; ++i, energy *= 1 - 1e-3) EXPECT_FALSE(fast.at_rest(energy)) << i;
  energy = 1;
  slow.at_rest(energy);
  slow.at_rest(energy *= 1 - 4e-4);
  EXPECT_TRUE(slow.at_rest(energy *= 1 - 4e-4));
}

TEST(RestDetector, DoesNotDependOnTheUnitOfTheEnergy) {
  RestDetector one(rest(1e-2, 3)), other(rest(1e-2, 3));
  double energy = 1;
  for (int i = 0; i < 30; ++i, energy *= 1 - .01 / (1 + i))
    EXPECT_EQ(one.at_rest(energy), other.at_rest(1024 * energy)) << i;
}

TEST(RestDetector, ZeroEnergyIsRest) {
  RestDetector detector(rest(1e-3, 1));
  detector.at_rest(0);
  EXPECT_TRUE(detector.at_rest(0));
}

TEST(CapDisplacement, ShortensWhatIsTooLongAndNothingElse) {
  const Mat3X u = test::random_vectors(5000, 1);
  std::vector<double> length(5000);
  for (size_t v = 0; v < length.size(); ++v) length[v] = .2 + 1e-4 * static_cast<double>(v);
  Mat3X capped = u;
  cap_displacement(length, 1.5, capped);
  int shortened = 0;
  for (Eigen::Index v = 0; v < u.cols(); ++v) {
    const double cap = 1.5 * length[v];
    if (u.col(v).norm() <= cap) {
      EXPECT_EQ(capped.col(v), u.col(v));
      continue;
    }
    ++shortened;
    EXPECT_NEAR(capped.col(v).norm(), cap, 1e-14);
    EXPECT_LT(capped.col(v).cross(u.col(v)).norm(), 1e-14);
    EXPECT_GT(capped.col(v).dot(u.col(v)), 0);
  }
  EXPECT_GT(shortened, 1000);
}

}  // namespace hooke::relaxation_test
