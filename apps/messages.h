// Messages for the user on standard error: errors, warnings, the summary and the progress line.
#pragma once

#include <string>

#include "hooke/remesh/result.h"
#include "hooke/report/report.h"
#include "options.h"

namespace hooke::app {

void print_error(const std::string& message);
void print_warning(const Warning& warning);
void print_note(const Note& note);
void print_warning(const Note& repair);

/// Prints the result in words and a table of the quality before and after; with --check, of the input only.
void print_summary(const Settings& settings, const RunRecord& run);

/// Explains why the paper's integrator stopped, by how often each of its tests limited the time step.
std::string paper_message(const RemeshResult& result);

/// A progress line that overwrites itself on a terminal.
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
