#include "hooke/measure/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <random>

namespace hooke::statistics_test {

TEST(Statistics, OfAKnownListAreExact) {
  const Statistics s = describe({5, 1, 4, 2, 3});
  EXPECT_EQ(s.min, 1);
  EXPECT_EQ(s.median, 3);
  EXPECT_EQ(s.mean, 3);
  EXPECT_EQ(s.max, 5);
  EXPECT_DOUBLE_EQ(s.std, std::sqrt(2.));  // of the population
  EXPECT_DOUBLE_EQ(s.p01, 1.04);
  EXPECT_DOUBLE_EQ(s.p05, 1.2);
  EXPECT_DOUBLE_EQ(s.p95, 4.8);
  EXPECT_EQ(s.count, 5u);
}

TEST(Statistics, NonFiniteNumbersAreCountedAndLeftOut) {
  const double inf = std::numeric_limits<double>::infinity();
  const Statistics s = describe({inf, 1, std::nan(""), 3, -inf});
  EXPECT_EQ(s.count, 2u);
  EXPECT_EQ(s.non_finite, 3u);
  EXPECT_EQ(s.mean, 2);
  EXPECT_EQ(s.max, 3);
}

TEST(Statistics, OfNothingAreNothing) {
  const Statistics s = describe({});
  EXPECT_TRUE(std::isnan(s.min) && std::isnan(s.mean) && std::isnan(s.std) && std::isnan(s.p95));
  EXPECT_TRUE(s.histogram.counts.empty());
}

TEST(Statistics, PercentilesAreThoseOfTheSortedList) {
  std::mt19937 random(1);
  const auto interpolated = [](const std::vector<double>& sorted, double share) {
    const double place = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<size_t>(place);
    const double next = sorted[std::min(below + 1, sorted.size() - 1)];
    return sorted[below] + (place - static_cast<double>(below)) * (next - sorted[below]);
  };
  std::normal_distribution<double> normal;
  const std::function<double()> laws[] = {
      [&] { return normal(random); },
      [&] { return std::exp(20 * normal(random)); },   // nearly all in the first bin
      [&] { return std::exp(300 * normal(random)); },  // down to denormal numbers, up to infinity
      [&] { return std::floor(3 * normal(random)); },  // few numbers, often
      [&] { return 1.7e308 * std::clamp(normal(random), -1., 1.); },  // a range beyond the largest number
      [&] { return 7.; },
  };
  for (const auto& law : laws)
    for (int count : {1, 2, 100, 5000}) {
      std::vector<double> values;
      for (int i = 0; i < count; ++i) values.push_back(law());
      const Statistics s = describe(values, {0, 60});
      std::erase_if(values, [](double x) { return !std::isfinite(x); });
      std::ranges::sort(values);
      if (values.empty()) continue;
      EXPECT_EQ(s.p01, interpolated(values, .01));
      EXPECT_EQ(s.p05, interpolated(values, .05));
      EXPECT_EQ(s.median, interpolated(values, .5));
      EXPECT_EQ(s.p95, interpolated(values, .95));
    }
}

TEST(Statistics, HistogramHoldsEveryNumberOnce) {
  std::vector<double> values;
  for (int i = 0; i < 1000; ++i) values.push_back(std::sin(i) * 30 + 30);
  for (const Bins& bins : {Bins{}, Bins{0, 60}, Bins{20, 30, 7}}) {
    const Histogram h = describe(values, bins).histogram;
    EXPECT_EQ(std::accumulate(h.counts.begin(), h.counts.end(), size_t{0}), values.size());
    EXPECT_EQ(h.edges.size(), h.counts.size() + 1);
    EXPECT_EQ(h.counts.size(), bins.count);
  }
}

TEST(Statistics, HistogramBinsAreClosedBelowAndOpenAbove) {
  const Histogram h = describe({-5, 0, 1, 1.5, 2, 3, 4, 9}, {0, 4, 4}).histogram;
  EXPECT_EQ(h.edges, (std::vector<double>{0, 1, 2, 3, 4}));
  EXPECT_EQ(h.counts, (std::vector<size_t>{2, 2, 1, 3}));  // what lies beyond counts at the ends
}

TEST(Statistics, EqualNumbersFillOneBin) {
  const Statistics s = describe({2, 2, 2});
  EXPECT_EQ(s.std, 0);
  EXPECT_EQ(s.histogram.counts, (std::vector<size_t>{3}));
  EXPECT_EQ(s.histogram.edges, (std::vector<double>{2, 2}));
}

}  // namespace hooke::statistics_test
