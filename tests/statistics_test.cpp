#include "hooke/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace hooke {
namespace {

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

TEST(Statistics, HistogramHoldsEveryNumberOnce) {
  std::vector<double> values;
  for (int i = 0; i < 1000; ++i) values.push_back(std::sin(i) * 30 + 30);
  for (const Bins& bins : {Bins{}, Bins{0, 60}, Bins{20, 30, 7}}) {
    const Histogram h = describe(values, bins).histogram;
    EXPECT_EQ(std::accumulate(h.counts.begin(), h.counts.end(), size_t{0}), values.size());
    EXPECT_EQ(h.edges.size(), h.counts.size() + 1);
    EXPECT_EQ(h.counts.size(), static_cast<size_t>(bins.count));
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

}  // namespace
}  // namespace hooke
