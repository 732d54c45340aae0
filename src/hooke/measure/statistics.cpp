#include "hooke/measure/statistics.h"

#include <algorithm>
#include <cmath>

namespace hooke {
namespace {

/// Bins of equal width between two numbers, up to rounding.
class EvenBins {
 public:
  EvenBins(double min, double max, size_t count)
      : min_(min), scale_(static_cast<double>(count) / (max - min)), last_(static_cast<double>(count - 1)) {}

  size_t operator()(double x) const { return std::min(last_, std::max(0., (x - min_) * scale_)); }

 private:
  double min_, scale_, last_;
};

struct Percentile {
  double share;
  double Statistics::*figure;
};
constexpr Percentile percentiles[] = {
    {.01, &Statistics::p01}, {.05, &Statistics::p05}, {.5, &Statistics::median}, {.95, &Statistics::p95}};

/// Linear interpolation between the sorted numbers; changes the order of `values`.
void take_percentiles(std::vector<double>& values, Statistics& s) {
  auto begin = values.begin();  // all values before it are smaller, because shares ascend
  for (const Percentile& p : percentiles) {
    const double position = p.share * static_cast<double>(values.size() - 1);
    const auto below = values.begin() + static_cast<std::ptrdiff_t>(position);
    std::nth_element(begin, below, values.end());
    const double next = below + 1 == values.end() ? *below : *std::min_element(below + 1, values.end());
    s.*p.figure = *below + (position - std::floor(position)) * (next - *below);
    begin = below;
  }
}

Histogram make_histogram(const std::vector<double>& values, const Statistics& s, const Bins& bins) {
  const bool given = bins.lower < bins.upper;
  const double lower = given ? bins.lower : s.min;
  const double upper = given ? bins.upper : s.max;
  const size_t n = lower < upper ? bins.count : 1;
  Histogram h;
  for (size_t k = 0; k < n; ++k)
    h.edges.push_back(lower + (upper - lower) * static_cast<double>(k) / static_cast<double>(n));
  h.edges.push_back(upper);
  h.counts.assign(n, 0);
  if (n == 1) {
    h.counts[0] = values.size();
    return h;
  }
  const EvenBins near(lower, upper, n);
  for (double x : values) {
    size_t k = near(x);  // exact up to rounding
    while (k > 0 && x < h.edges[k]) --k;
    while (k + 1 < n && x >= h.edges[k + 1]) ++k;
    ++h.counts[k];
  }
  return h;
}

}  // namespace

Statistics describe(std::vector<double> values, const Bins& bins) {
  Statistics s;
  const size_t given = values.size();
  std::erase_if(values, [](double x) { return !std::isfinite(x); });
  s.count = values.size();
  s.non_finite = given - values.size();
  if (values.empty()) return s;

  const auto n = static_cast<double>(values.size());
  double sum = 0;
  for (double x : values) sum += x;
  s.mean = sum / n;
  double squares = 0;
  for (double x : values) squares += (x - s.mean) * (x - s.mean);
  s.std = std::sqrt(squares / n);

  const auto [min, max] = std::ranges::minmax(values);
  s.min = min;
  s.max = max;
  take_percentiles(values, s);
  s.histogram = make_histogram(values, s, bins);
  return s;
}

}  // namespace hooke
