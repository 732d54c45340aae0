// The rows from which the table of the report's keys is made; report_keys.h looks keys up in it.
#pragma once

#include <string>
#include <vector>

#include "hooke/report/report_keys.h"

namespace hooke::report_table {

/// The parts of a text between the separators.
std::vector<std::string> split(const std::string& text, char separator);

/// See report_keys().
std::vector<ReportKey> all_keys();

}  // namespace hooke::report_table
