// Statistics of a list of numbers: range, percentiles, standard deviation and histogram.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace hooke {

/// counts[k] numbers lie in [edges[k], edges[k + 1]); the last bin includes its upper edge.
struct Histogram {
  std::vector<double> edges;
  std::vector<std::size_t> counts;
};

/// All values are NaN, and the histogram is empty, if there was no finite number.
struct Statistics {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double min = none;
  double p01 = none;  // percentiles by linear interpolation between the sorted numbers
  double p05 = none;
  double median = none;
  double mean = none;
  double p95 = none;
  double max = none;
  double std = none;  // of the population: divides by n
  Histogram histogram;
  std::size_t count = 0;       // finite numbers, to which the values above refer
  std::size_t non_finite = 0;  // numbers left out
};

/// Bins of a histogram. With lower >= upper they cover the range of the numbers.
struct Bins {
  double lower = 0;
  double upper = 0;  // numbers outside count in the first or the last bin
  int count = 20;
};

/// Statistics of the finite values.
Statistics describe(std::vector<double> values, const Bins& bins = {});

}  // namespace hooke
