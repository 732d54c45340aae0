// What a list of numbers looks like: range, percentiles, spread, histogram.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace hooke {

/// counts[k] numbers lie in [edges[k], edges[k + 1]); the last bin holds its upper edge too.
struct Histogram {
  std::vector<double> edges;
  std::vector<std::size_t> counts;
};

/// All figures are NaN, and the histogram is empty, when there was no finite number.
struct Statistics {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double min = none;
  double p01 = none;  // percentiles by linear interpolation between the sorted numbers
  double p05 = none;
  double median = none;
  double mean = none;
  double p95 = none;
  double max = none;
  double std = none;  // of the population: divided by n
  Histogram histogram;
  std::size_t count = 0;       // finite numbers: all that the figures above speak of
  std::size_t non_finite = 0;  // numbers left out
};

/// Where the histogram lies. With lower >= upper it covers the range of the numbers themselves.
struct Bins {
  double lower = 0;
  double upper = 0;  // numbers beyond the ends count in the first and the last bin
  int count = 20;
};

Statistics describe(std::vector<double> values, const Bins& bins = {});

}  // namespace hooke
