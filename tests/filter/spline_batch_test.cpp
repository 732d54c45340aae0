#include "hooke/filter/spline_batch.h"

#include <gtest/gtest.h>

#include <random>

namespace hooke::spline_batch_test {

/// A bent sheet of about unit size with points above and below it, values their heights.
SplineData sheet(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(-.7, .7);
  SplineData data;
  data.clear(count);
  for (int i = 0; i < count; ++i) {
    const double x = coordinate(random), y = coordinate(random),
                 height = i % 4 == 0   ? .1
                          : i % 4 == 2 ? -.1
                                       : 0;
    data.add({x, y, .2 * x * x - .1 * x * y * y + height}, height);
  }
  return data;
}

SplineGroup::Data sheets() {
  return {sheet(40, 1), sheet(23, 2), sheet(41, 3), sheet(31, 4)};
}

std::vector<double> all_of(const SplineCoefficients& spline) {
  std::vector<double> values = spline.radial;
  values.insert(values.end(), spline.polynomial.begin(), spline.polynomial.end());
  return values;
}

std::vector<double> solution(const SplineGroup& group, const SplineGroup::Data& data, std::size_t lane) {
  return all_of(group.solution(lane, data[lane].count));
}

constexpr SplineGroup::Flags all = {true, true, true, true};
constexpr double min_distance = 1e-6;

class GroupOfEachKernel : public testing::TestWithParam<Kernel> {};
INSTANTIATE_TEST_SUITE_P(SplineGroup, GroupOfEachKernel, testing::Values(Kernel::r2logr, Kernel::r3));

TEST_P(GroupOfEachKernel, FindsTheSplinesThatFitSplineFinds) {
  const SplineGroup::Data data = sheets();
  SplineGroup group;
  ASSERT_EQ(group.fit(data, all, GetParam(), min_distance), all);
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    const SplineData& one = data[lane];
    const std::vector<double> together = solution(group, data, lane);
    SplineWorkspace workspace;
    const auto fitted =
        fit_spline(one.centres.leftCols(one.count), one.values.head(one.count), GetParam(), 2, workspace);
    ASSERT_TRUE(fitted);
    const std::vector<double> alone = all_of(*fitted);
    ASSERT_EQ(together.size(), alone.size());
    for (std::size_t i = 0; i < alone.size(); ++i)
      EXPECT_NEAR(together[i], alone[i], 1e-9 * (1 + std::abs(alone[i]))) << i;
  }
}

TEST_P(GroupOfEachKernel, ASplineDoesNotKnowWhichOthersAreInItsGroup) {
  const SplineGroup::Data data = sheets();
  SplineGroup group;
  group.fit(data, all, GetParam(), min_distance);
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    const std::vector<double> together = solution(group, data, lane);
    SplineGroup::Data moved;
    moved[3 - lane] = data[lane];
    SplineGroup::Flags wanted{};
    wanted[3 - lane] = true;
    SplineGroup other;
    ASSERT_EQ(other.fit(moved, wanted, GetParam(), min_distance), wanted);
    EXPECT_EQ(solution(other, moved, 3 - lane), together);
  }
}

TEST(SplineGroup, TellsWhichDataDoNotDetermineASpline) {
  SplineGroup::Data data = sheets();
  data[0].centres.row(2).setZero();                  // on a plane
  data[2].centres.col(17) = data[2].centres.col(3);  // two equal positions
  SplineGroup group;
  const SplineGroup::Flags expected = {false, true, false, true};
  EXPECT_EQ(group.fit(data, all, Kernel::r3, min_distance), expected);

  const SplineGroup::Data few = {sheet(9, 1), sheet(9, 2), sheet(9, 3), sheet(9, 4)};
  EXPECT_EQ(group.fit(few, all, Kernel::r3, min_distance), SplineGroup::Flags{});
  EXPECT_EQ(group.fit(data, {}, Kernel::r3, min_distance), SplineGroup::Flags{});
}

TEST(SplineData, DropsWhatRepeatsAPlaceAndKeepsTheFirst) {
  SplineData data;
  data.clear(4);
  data.add({0, 0, 0}, 1);
  data.add({1, 0, 0}, 2);
  data.add({0, 1e-8, 0}, 3);
  data.add({0, 1, 0}, 4);
  data.drop_repeated(1e-6);
  ASSERT_EQ(data.count, 3);
  EXPECT_EQ(data.values.head(3), Vec3(1, 2, 4));
  EXPECT_EQ(data.centres.col(2), Vec3(0, 1, 0));
}

}  // namespace hooke::spline_batch_test
