#include "hooke/statistics.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "hooke/radix_sort.h"

namespace hooke {
namespace {

/// As an unsigned integer of the same order: a negative number has its bits turned, others their sign.
std::uint64_t to_key(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  return bits >> 63 ? ~bits : bits | std::uint64_t{1} << 63;
}

double percentile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<size_t>(place);
  if (below + 1 >= sorted.size()) return sorted.back();
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[below + 1] - sorted[below]);
}

Histogram make_histogram(const std::vector<double>& sorted, const Bins& bins) {
  const bool given = bins.lower < bins.upper;
  const double lower = given ? bins.lower : sorted.front();
  const double upper = given ? bins.upper : sorted.back();
  const int n = lower < upper ? bins.count : 1;
  Histogram h;
  for (int k = 0; k < n; ++k) h.edges.push_back(lower + (upper - lower) * k / n);
  h.edges.push_back(upper);
  auto begin = sorted.begin();
  for (size_t k = 0; k < static_cast<size_t>(n); ++k) {
    const bool last = k + 1 == static_cast<size_t>(n);
    const auto end = last ? sorted.end() : std::lower_bound(begin, sorted.end(), h.edges[k + 1]);
    h.counts.push_back(static_cast<size_t>(end - begin));
    begin = end;
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
  {
    std::vector<double> buffer(values.size());
    radix_sort<double>(values, buffer, to_key);
  }

  const auto n = static_cast<double>(values.size());
  double sum = 0;
  for (double x : values) sum += x;
  s.mean = sum / n;
  double squares = 0;
  for (double x : values) squares += (x - s.mean) * (x - s.mean);
  s.std = std::sqrt(squares / n);

  s.min = values.front();
  s.p01 = percentile(values, .01);
  s.p05 = percentile(values, .05);
  s.median = percentile(values, .5);
  s.p95 = percentile(values, .95);
  s.max = values.back();
  s.histogram = make_histogram(values, bins);
  return s;
}

}  // namespace hooke
