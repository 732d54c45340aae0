// The keys of the report: path, type, unit, meaning, and which way is worse. Gates and comparisons look them
// up in this table (report_key_table.cpp); the list of --list-metrics, the JSON Schema and the page about the
// report are made from it.
#pragma once

#include <string>
#include <vector>

namespace hooke {

enum class KeyKind { text, number, integer, boolean, object, list };

/// Which way a number gets better; `neither` also for what is no figure of merit.
enum class Better { neither, higher, lower, nearer_zero };

/// A key of the report.
struct ReportKey {
  /// Keys with dots between them; <n> stands for an index of a list, from 0, and <name> for a key that
  /// depends on the run, such as the name of a stage.
  std::string path;
  KeyKind kind = KeyKind::number;
  bool may_be_null = false;
  std::string unit;  // empty for none
  Better better = Better::neither;
  std::string meaning;
  bool of_result = false;  // null, absent or empty with --check, which has no result
  std::string row;         // of the table: keys of the same row have the same contents
};

/// All keys, objects and lists before what is in them, in the order of the report.
const std::vector<ReportKey>& report_keys();

/// Whether values of the key are numbers for a gate: yes and no are 1 and 0.
bool is_number(const ReportKey& key);

/// The key that a path names, with digits for <n> and any name for <name>; null if there is none.
const ReportKey* find_report_key(const std::string& path);

/// The path of the number that is written most like this one, in the same block if there is one.
std::string nearest_number(const std::string& path);

/// Names of the keys in the block `parameters`.
std::vector<std::string> parameter_names();

/// All keys but those of objects and lists, one or more lines of at most 80 columns each: path, meaning,
/// unit.
std::string keys_as_text();

/// The page src/hooke/report/README.md.
std::string keys_as_page();

/// The JSON Schema (draft 2020-12) of a report, src/hooke/report/report.schema.json: every key is required,
/// and no other allowed.
std::string report_schema();

}  // namespace hooke
