#include "hooke/core/stopwatch.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <ctime>

namespace hooke {
namespace {

double seconds_of(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace

size_t Stopwatch::find(const std::string& name) {
  const auto known = std::ranges::find(stages_, name, &StageTime::name);
  const size_t index = known - stages_.begin();
  if (known == stages_.end()) stages_.push_back({.name = name});
  return index;
}

Stage::Stage(Stopwatch* stopwatch, const char* name) : stopwatch_(stopwatch) {
  if (!stopwatch_) return;
  std::string& running = stopwatch_->running_;
  outer_length_ = running.size();
  if (!running.empty()) running += '/';
  running += name;
  stage_ = stopwatch_->find(running);
  wall_ = seconds_of(CLOCK_MONOTONIC);
  cpu_ = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
}

Stage::~Stage() {
  if (!stopwatch_) return;
  StageTime& time = stopwatch_->stages_[stage_];
  ++time.calls;
  time.cpu_s += seconds_of(CLOCK_PROCESS_CPUTIME_ID) - cpu_;
  time.wall_s += seconds_of(CLOCK_MONOTONIC) - wall_;
  time.peak_rss_bytes = process_use().peak_rss_bytes;
  stopwatch_->running_.resize(outer_length_);
}

std::string trace_csv(const std::vector<StageTime>& stages) {
  std::string text = "stage,calls,wall_s,cpu_s,peak_rss_bytes\n";
  for (const StageTime& s : stages)
    text += fmt::format("{},{},{:.6f},{:.6f},{}\n", s.name, s.calls, s.wall_s, s.cpu_s, s.peak_rss_bytes);
  return text;
}

ProcessUse process_use() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  constexpr long long bytes_per_unit = 1024;
  return {seconds_of(CLOCK_PROCESS_CPUTIME_ID), usage.ru_maxrss * bytes_per_unit};
}

}  // namespace hooke
