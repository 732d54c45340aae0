// The table of the report's keys as people and programs read it.
#pragma once

#include <string>

namespace hooke {

/// All keys but those of objects and lists, one or more lines of at most 80 columns each: path, meaning,
/// unit.
std::string keys_as_text();

/// The page src/hooke/report/README.md.
std::string keys_as_page();

/// The JSON Schema (draft 2020-12) of a report, src/hooke/report/report.schema.json: every key is required,
/// and no other allowed.
std::string report_schema();

}  // namespace hooke
