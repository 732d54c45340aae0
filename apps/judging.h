// Judges a run by its report: the conditions of --require and the older report of --compare.
#pragma once

#include <optional>

#include "hooke/report/comparison.h"
#include "hooke/report/report.h"
#include "options.h"

namespace hooke::app {

/// The figures of the report that --compare names; none without it. Throws InputError if it cannot be read or
/// is no report.
std::optional<ReportFigures> read_base(const Settings& settings);

/// Records what becomes of the conditions and of the comparison. Pre-condition: all else is recorded.
void judge(const Settings& settings, const std::optional<ReportFigures>& base, RunRecord& record);

/// Whether all conditions hold, and something could be compared and nothing got worse.
bool passes(const RunRecord& record);

/// Prints what does not hold or got worse as errors, and what could not be compared as warnings.
void print_judgement(const Settings& settings, const RunRecord& record);

}  // namespace hooke::app
