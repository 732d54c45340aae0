// A line on the terminal that tells how far a run is.
#pragma once

#include <chrono>
#include <string>

#include "hooke/integrator/integration.h"
#include "options.h"

namespace hooke::app {

/// Whether progress is shown: on a terminal, or if it was asked for; never with --quiet.
bool shows_progress(const Settings& settings);

/// Tells processes that are started from now on how wide the terminal is, which they do not see themselves.
void hand_on_columns();

/// A bar on the last line of standard error, with the time that is left if things go on as they did. Without
/// colours. Leaves a clean line at its end.
class ProgressBar {
 public:
  explicit ProgressBar(bool enabled) : enabled_(enabled) {}
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Whether it is shown and the line is older than a tenth of a second.
  bool is_due() const;

  /// Shows what goes on, and the share from 0 to 1 that is done.
  void show(const std::string& what, double share);

  /// Leaves the line empty, for other messages.
  void clear();

 private:
  bool enabled_;
  std::size_t shown_ = 0;  // columns in use
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now(), last_ = start_;
};

/// The progress of a run on one mesh. The share is an estimate by the times that its parts took elsewhere:
/// how many steps they take is not known before.
class RunProgress {
 public:
  explicit RunProgress(const Settings& settings);

  /// Outside the optimization: "read", "measure" or "write".
  void enter(const char* part);
  void show(const Progress& progress);
  void clear() { bar_.clear(); }

 private:
  double share_of(const Progress& progress);

  ProgressBar bar_;
  ConnectivityMode mode_;
  bool paper_;
  int last_outer_, last_step_;
  double share_ = 0;      // does not fall
  std::string stage_;     // of the last progress
  int outer_ = 0;         // of the last progress
  std::size_t part_ = 0;  // the part of the run that it belongs to
  int rounds_ = 0;        // begun in that part
};

}  // namespace hooke::app
