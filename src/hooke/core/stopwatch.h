// Measures the time of each stage of a run and the peak memory of the process.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace hooke {

/// Totals over all calls of one stage.
struct StageTime {
  std::string name;  // with the names of the enclosing stages: "measure/distances"
  long long calls = 0;
  double wall_s = 0;
  double cpu_s = 0;              // all threads of the process
  long long peak_rss_bytes = 0;  // of the process, at the end of the last call
};

/// Collects the times of the stages. Not thread-safe: all stages must run on the same thread.
class Stopwatch {
 public:
  /// In the order in which they were first started; a stage precedes those nested in it.
  const std::vector<StageTime>& stages() const { return stages_; }

 private:
  friend class Stage;
  size_t find(const std::string& name);

  std::vector<StageTime> stages_;
  std::string running_;  // names of the running stages, separated by '/'
};

/// Times a stage for the lifetime of this object. Without a stopwatch (null) nothing is measured.
class Stage {
 public:
  Stage(Stopwatch* stopwatch, const char* name);
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

 private:
  Stopwatch* stopwatch_;
  size_t stage_ = 0;
  size_t outer_length_ = 0;  // of `running_` without this stage
  double wall_ = 0, cpu_ = 0;
};

/// Returns work(), timed as a stage.
template <typename Work>
auto timed(Stopwatch* stopwatch, const char* name, const Work& work) {
  const Stage stage(stopwatch, name);
  return work();
}

/// The stages as CSV text: a line of column names, then a line per stage.
std::string trace_csv(const std::vector<StageTime>& stages);

/// Resources that the process has used so far.
struct ProcessUse {
  double cpu_s = 0;
  long long peak_rss_bytes = 0;
};
ProcessUse process_use();

}  // namespace hooke
