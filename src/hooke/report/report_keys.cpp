#include "hooke/report/report_keys.h"

#include <algorithm>

#include "hooke/core/edit_distance.h"
#include "hooke/report/report_key_table.h"

namespace hooke {
namespace {

using report_table::split;

bool is_index(const std::string& key) {
  return !key.empty() && std::ranges::all_of(key, [](char c) { return c >= '0' && c <= '9'; });
}

/// Whether a path of a report is one that the key stands for.
bool matches(const std::string& pattern, const std::string& path) {
  const std::vector<std::string> keys = split(pattern, '.'), given = split(path, '.');
  if (keys.size() != given.size()) return false;
  for (size_t k = 0; k < keys.size(); ++k)
    if (keys[k] == "<n>" ? !is_index(given[k]) : keys[k] != "<name>" && keys[k] != given[k]) return false;
  return true;
}

}  // namespace

const std::vector<ReportKey>& report_keys() {
  static const std::vector<ReportKey> keys = report_table::all_keys();
  return keys;
}

bool is_number(const ReportKey& key) {
  return key.kind == KeyKind::number || key.kind == KeyKind::integer || key.kind == KeyKind::boolean;
}

const ReportKey* find_report_key(const std::string& path) {
  const auto& keys = report_keys();
  const auto found =
      std::ranges::find_if(keys, [&](const ReportKey& key) { return matches(key.path, path); });
  return found == keys.end() ? nullptr : &*found;
}

std::string nearest_number(const std::string& path) {
  const std::string block = path.substr(0, path.find('.')) + ".";
  const bool is_block =
      std::ranges::any_of(report_keys(), [&](const ReportKey& key) { return key.path.starts_with(block); });
  std::string nearest;
  size_t least = std::string::npos;
  for (const ReportKey& key : report_keys())
    if (is_number(key) && (!is_block || key.path.starts_with(block)))
      if (const size_t distance = edit_distance(path, key.path); distance < least) {
        least = distance;
        nearest = key.path;
      }
  return nearest;
}

std::vector<std::string> parameter_names() {
  const std::string block = "parameters.";
  std::vector<std::string> names;
  for (const ReportKey& key : report_keys())
    if (key.path.starts_with(block) && key.path.find('.', block.size()) == std::string::npos)
      names.push_back(key.path.substr(block.size()));
  return names;
}

}  // namespace hooke
