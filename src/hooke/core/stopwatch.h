// How long each part of the work takes, and how much memory the process has used by then.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace hooke {

/// All calls of one stage together.
struct StageTime {
  std::string name;  // a stage within another one carries its name too: "measure/distances"
  long long calls = 0;
  double wall_s = 0;
  double cpu_s = 0;              // of all threads of the process
  long long peak_rss_bytes = 0;  // of the process so far, at the end of the last call
};

/// Keeps the account; each Stage adds to it. To be used by one thread, the one that calls the stages.
class Stopwatch {
 public:
  /// In the order in which they were first begun; a stage stands before the ones within it.
  const std::vector<StageTime>& stages() const { return stages_; }

 private:
  friend class Stage;
  size_t find(const std::string& name);

  std::vector<StageTime> stages_;
  std::string running_;  // the names of the stages begun and not ended, '/' between them
};

/// A stage that lasts as long as this object. Without a stopwatch nothing is measured.
class Stage {
 public:
  Stage(Stopwatch* stopwatch, const char* name);
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

 private:
  Stopwatch* stopwatch_;
  size_t stage_ = 0;
  size_t outer_length_ = 0;  // of the running names without ours
  double wall_ = 0, cpu_ = 0;
};

/// What work() returns; it is timed as a stage.
template <typename Work>
auto timed(Stopwatch* stopwatch, const char* name, const Work& work) {
  const Stage stage(stopwatch, name);
  return work();
}

/// The account as CSV text: a line of column names, then a line per stage.
std::string trace_csv(const std::vector<StageTime>& stages);

/// What the process has used so far.
struct ProcessUse {
  double cpu_s = 0;
  long long peak_rss_bytes = 0;
};
ProcessUse process_use();

}  // namespace hooke
