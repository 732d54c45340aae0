// What a result must not hide.
#pragma once

#include "hooke/report/report.h"
#include "options.h"

namespace hooke::app {

/// The target length is out of reach for as many faces as there are. `length` is the covering_length() of the
/// targets.
void warn_of_length(const Settings& settings, double length, double natural, RunRecord& run);

/// So many boundary vertices share their place with another.
void warn_of_coincident_boundary(std::size_t count, RunRecord& run);

/// Faces that lie wrong, a surface that was left, counts and lengths that were missed. Pre-condition: the run
/// has a result, which was measured.
void add_result_warnings(const Settings& settings, RunRecord& run);

}  // namespace hooke::app
