// What people read on standard error.
#pragma once

#include <string>

#include "hooke/remesh/result.h"
#include "hooke/report/report.h"
#include "options.h"

namespace hooke::app {

void print_error(const std::string& message);
void print_warning(const Warning& warning);

/// The result in words and the before/after table. With check the one mesh on its own.
void print_summary(const Settings& settings, const RunRecord& run);

/// Why the paper's own scheme came no further: which of its tests set the time steps.
std::string paper_message(const RemeshResult& result);

/// A line that overwrites itself on a terminal and says where the work stands.
class ProgressLine {
 public:
  explicit ProgressLine(const Settings& settings);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(const Progress& progress);

 private:
  bool enabled_;
  bool shown_ = false;
  long long last_ms_ = 0;
};

}  // namespace hooke::app
