#include "hooke/statistics.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace hooke {
namespace {

/// Even bins between two numbers. Of two numbers the lesser is in no later bin.
class EvenBins {
 public:
  EvenBins(double least, double greatest, size_t count)
      : least_(least),
        scale_(static_cast<double>(count) / (greatest - least)),
        last_(static_cast<double>(count - 1)) {}

  /// Is the range one that numbers can divide?
  bool are_distinct() const { return scale_ > 0 && std::isfinite(scale_); }

  size_t operator()(double x) const {
    return static_cast<size_t>(std::min(last_, std::max(0., (x - least_) * scale_)));
  }

 private:
  double least_, scale_, last_;
};

/// Writes the numbers that would stand at the given places if all were sorted. Only those are sorted that
/// share a bin with one of them. Places ascend where there are more than a few numbers.
void find_at(const std::vector<double>& values, std::span<const size_t> places, double* found) {
  constexpr size_t few = 256, most_bins = 4096;
  const auto [least, greatest] = std::ranges::minmax(values);
  const EvenBins bin_of(least, greatest, most_bins);
  if (values.size() <= few || !bin_of.are_distinct()) {
    std::vector<double> sorted = values;
    std::ranges::sort(sorted);
    for (size_t i = 0; i < places.size(); ++i) found[i] = sorted[places[i]];
    return;
  }
  std::vector<size_t> counts(most_bins, 0);
  for (double x : values) ++counts[bin_of(x)];

  struct Wanted {
    size_t begin, first, count;  // of its numbers, of the places in it
    std::vector<double> values;
  };
  std::vector<Wanted> wanted;
  std::vector<int> wanted_of(most_bins, -1);
  size_t begin = 0, place = 0;
  for (size_t b = 0; b < most_bins; begin += counts[b++]) {
    const size_t first = place;
    while (place < places.size() && places[place] < begin + counts[b]) ++place;
    if (place == first) continue;
    wanted_of[b] = static_cast<int>(wanted.size());
    wanted.push_back({begin, first, place - first, {}});
    wanted.back().values.reserve(counts[b]);
  }
  for (double x : values)
    if (const int w = wanted_of[bin_of(x)]; w >= 0) wanted[static_cast<size_t>(w)].values.push_back(x);
  for (const Wanted& w : wanted) {
    std::vector<size_t> inside;
    for (size_t p : places.subspan(w.first, w.count)) inside.push_back(p - w.begin);
    find_at(w.values, inside, found + w.first);
  }
}

struct Percentile {
  double share;
  double Statistics::*figure;
};
constexpr Percentile percentiles[] = {
    {.01, &Statistics::p01}, {.05, &Statistics::p05}, {.5, &Statistics::median}, {.95, &Statistics::p95}};

/// By linear interpolation between the sorted numbers.
void take_percentiles(const std::vector<double>& values, Statistics& s) {
  const size_t last = values.size() - 1;
  std::vector<size_t> places;
  for (const Percentile& p : percentiles) {
    const auto below = static_cast<size_t>(p.share * static_cast<double>(last));
    places.insert(places.end(), {below, std::min(below + 1, last)});
  }
  std::vector<double> found(places.size());
  find_at(values, places, found.data());
  for (size_t i = 0; i < std::size(percentiles); ++i) {
    const double place = percentiles[i].share * static_cast<double>(last);
    s.*percentiles[i].figure =
        found[2 * i] + (place - static_cast<double>(places[2 * i])) * (found[2 * i + 1] - found[2 * i]);
  }
}

Histogram make_histogram(const std::vector<double>& values, const Statistics& s, const Bins& bins) {
  const bool given = bins.lower < bins.upper;
  const double lower = given ? bins.lower : s.min;
  const double upper = given ? bins.upper : s.max;
  const size_t n = lower < upper ? static_cast<size_t>(bins.count) : 1;
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
    size_t k = near(x);  // but for rounding
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

  const auto [least, greatest] = std::ranges::minmax(values);
  s.min = least;
  s.max = greatest;
  take_percentiles(values, s);
  s.histogram = make_histogram(values, s, bins);
  return s;
}

}  // namespace hooke
