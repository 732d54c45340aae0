// Messages for the user on standard error: errors, warnings and the summary.
#pragma once

#include <string>
#include <string_view>

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

/// Prints text of this program or another of its kind, which may be several lines.
void print_text_as_it_is(std::string_view text);

}  // namespace hooke::app
